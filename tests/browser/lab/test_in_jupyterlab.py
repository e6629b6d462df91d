"""A student's way: unpack the archive, `course lab`, a chapter, a robot that walks, a prediction, a handed-in exercise.

What the course shows in JupyterLab is judged by axe-core on the way; JupyterLab's own frame is not.
"""

from __future__ import annotations

import io
import os
import re
import shutil
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path

import nbformat
import numpy as np
import psutil
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from PIL import Image
from playwright.sync_api import Locator, Page, expect, sync_playwright

from accessibility import require_accessible, violations
from autograder.classroom.archives.student_bundle import TOP, write_bundle
from chromium import CHROMIUM, OFFLINE, needs_chromium
from ros_runtime.project import PROJECT, TOOLKIT

TIMEOUT = 90.0  # s, for each thing a busy machine has to do
PICTURE = ".jp-OutputArea .widget-image"
OUTPUTS = ".jp-OutputArea-output"
KERNEL = {"kernelspec": {"name": "python3", "display_name": "Python 3 (ipykernel)"}}
# Kinds of outputs that the other tests do not show.
OTHER_OUTPUTS = (
    "import lab, numpy\nx = numpy.linspace(0.0, 1.0, 20)",
    'lab.quiz("services", 1)',
    "lab.choose_pattern()",
    'lab.slide("gain", (0.5, 1.0), lambda k: lab.plot_curves({"a": (x, k * x)}, "t, s", "m"), start=1.0)',
    """
from ros_runtime.drawing.sequence_diagram import Arrow, sequence_svg
from IPython.display import HTML
names = ["notebook", "parent", "child", "motors", "robot", "world", "moon"]
HTML(sequence_svg([Arrow(0.0, *names[:2], "request")], title="Wide", participants=names))""",
    """
display({"text/plain": ""}, raw=True)  # a notice that was removed
of_an_ended_kernel = {"version_major": 2, "version_minor": 0, "model_id": "ended"}
display({"application/vnd.jupyter.widget-view+json": of_an_ended_kernel}, raw=True)""",
    "%%gap merged.py\nnothing",
)
UNNAMED_SLIDER = {"aria-input-field-name": "ipywidgets 8 names the label beside a slider, not its handle"}
PATTERNS = {"t": "topic", "s": "service", "a": "action"}
# The right answers to the exercise `patterns`: for each situation the pattern and the reason.
ANSWERS = ["ta", "sb", "ac", "ta", "sb", "aa", "tb", "sc", "ab", "tc", "sa", "ac"]

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder in which a student has unpacked the archive."""
    folder = tmp_path_factory.mktemp("student")
    write_bundle(Path(__file__).resolve().parents[3], folder / "students.zip")
    with zipfile.ZipFile(folder / "students.zip") as bundle:
        bundle.extractall(folder)
    return folder


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    """The address at which `course lab` serves the students' archive, with no earlier settings of Jupyter."""
    command = [
        sys.executable,
        "-c",
        "from course_cli.app import main; main()",
        "lab",
        "--no-browser",
        "--port",
        "0",
    ]
    environment = {
        **os.environ,
        "HOME": str(folder),
        "PYTHONPATH": str(folder / TOP / TOOLKIT),
    }
    with subprocess.Popen(
        command,
        cwd=folder / TOP,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    ) as server:
        assert server.stderr
        yield next(line.strip() for line in server.stderr if "http://127.0.0.1" in line)
        started = psutil.Process(server.pid).children(recursive=True)
        server.terminate()
        server.communicate(timeout=TIMEOUT)
        _, left_behind = psutil.wait_procs(started, timeout=TIMEOUT)
        assert left_behind == []


@pytest.fixture
def page(address: str) -> Iterator[Page]:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=OFFLINE)
        page = browser.new_page(viewport={"width": 1100, "height": 1000})
        page.set_default_timeout(1000 * TIMEOUT)
        page.goto(f"{address}&reset")  # without the tabs of an earlier test
        yield page
        browser.close()


def test_from_the_start_page_to_a_robot_that_walks(page: Page) -> None:
    page.get_by_role("link", name="The robot and its graph").click()
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    require_saved(page)  # although JupyterLab copies the kernel's version into it
    assert page.get_by_text("Validate", exact=True).count() == 0  # nbgrader's, with a time limit of its own

    page.get_by_role("heading", name="1 · The robot and its graph").click()
    page.keyboard.press("Shift+Enter")
    page.keyboard.press("Shift+Enter")
    page.get_by_title("The robot: STANDING").wait_for()
    standing = seen(page)
    assert len(np.unique(standing.reshape(-1, 3), axis=0)) > 500  # a robot on a floor, not an empty frame

    page.keyboard.press("Shift+Enter")
    page.keyboard.press("Shift+Enter")
    deadline = time.monotonic() + TIMEOUT
    while np.mean(abs(seen(page) - standing) > 20) < 0.05:
        assert time.monotonic() < deadline, f"the picture has not moved within {TIMEOUT:g} s"
    assert re.match(r"The robot: [A-Z]+ at ", page.locator(PICTURE).get_attribute("title") or "")
    require_accessible(page, OUTPUTS)


def test_the_robot_is_shown_beside_the_notebook_that_has_it(page: Page, folder: Path, address: str) -> None:
    for name in ("first", "second"):
        write(folder / f"{TOP}/chapters/{name}.ipynb", new_code_cell("import lab\n\nlab.start_robot()"))
    page.set_viewport_size({"width": 1280, "height": 720})
    open_chapter(page, address, "first")
    run_first_cell(page, "first")
    picture = page.locator(".course-live img")
    page.get_by_text("STANDING at").wait_for()
    shown, text = picture.bounding_box(), page.get_by_label("first.ipynb").bounding_box()
    assert shown
    assert text
    assert text["width"] > 900  # the file browser has folded
    assert text["x"] + text["width"] <= shown["x"]
    assert shown["y"] + shown["height"] < 720

    page.reload()
    page.get_by_text("STANDING at").wait_for()
    assert page.get_by_text("model not found").count() == 0
    page.locator('[data-command="docmanager:save"]').first.click()
    require_saved(page)
    page.locator(".lm-DockPanel .lm-TabBar-tab", has_text="first").locator(".lm-TabBar-tabCloseIcon").click()
    page.locator('.jp-mod-left [data-id="filebrowser"]').click()
    page.get_by_role("listitem", name="Name: first.ipynb").dblclick()
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    page.get_by_text("STANDING at").wait_for()
    expect(panels(page)).to_have_count(1)

    open_chapter(page, address, "second")
    run_first_cell(page, "second")
    page.get_by_text("The robot of first.ipynb has ended").wait_for()
    page.get_by_text("STANDING at").wait_for()
    page.get_by_text("The robot of second.ipynb").wait_for()
    expect(panels(page)).to_have_count(1)
    assert page.locator(".course-live").evaluate("panel => panel.scrollWidth <= panel.clientWidth")

    restart_kernel(page)
    ended = page.get_by_text("This picture no longer moves")
    ended.wait_for()
    icons = "parts => parts.map(part => getComputedStyle(part, '::before').display)"
    assert set(page.locator(".course-live .jupyter-widgets-disconnected").evaluate_all(icons)) == {"none"}
    run_first_cell(page, "second")
    ended.wait_for(state="hidden")
    page.get_by_text("STANDING at").wait_for()
    expect(panels(page)).to_have_count(1)


def test_the_first_page_shows_what_is_done_and_a_first_step(page: Page) -> None:
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    page.get_by_text("import lab").click()
    page.keyboard.press("Shift+Enter")
    page.get_by_text("Nothing done yet. Your first step").wait_for()
    assert page.get_by_label("Predictions: 0 of").count() >= 5
    sizes = "rows => rows.flatMap(row => [row.offsetWidth, row.offsetHeight])"
    widths_and_heights = page.get_by_role("row").evaluate_all(sizes)
    assert max(widths_and_heights[::2]) <= 576  # px; beside the panel of the robot there is no more
    assert max(widths_and_heights[1::2]) < 35  # px, of one line
    require_accessible(page, OUTPUTS)
    page.get_by_role("row").get_by_role("link", name="battery_service").click()
    page.get_by_role("heading", name="Battery service").wait_for()


def test_what_unfolds_comes_into_view(page: Page, folder: Path, address: str) -> None:
    film = (
        "<p style='height: 450px'></p><details><summary>Film</summary><p style='height: 400px'></p></details>"
    )
    cell = new_code_cell(f'from IPython.display import HTML\n\nHTML("{film}")')
    write(folder / f"{TOP}/chapters/film.ipynb", cell)
    page.set_viewport_size({"width": 1280, "height": 720})
    open_chapter(page, address, "film")
    page.get_by_text("from IPython.display").click()
    page.keyboard.press("Shift+Enter")
    page.locator("summary", has_text="Film").click()
    expect(page.locator("details > p")).to_be_in_viewport(ratio=1)


def test_a_prediction_is_made_by_key_and_by_click(page: Page, folder: Path, address: str) -> None:
    cells = [
        new_code_cell('import lab\n\nprediction_1 = lab.predict("services", 1)\nprediction_1'),
        new_code_cell("prediction_1.reply()"),
        new_markdown_cell("There is **no response**."),
        new_code_cell("print('experiment', 2)"),
        new_markdown_cell("It printed **more**."),
        new_markdown_cell("### Your lines"),
        new_markdown_cell("## The next part"),
    ]
    write(folder / TOP / "chapters" / "predict.ipynb", *cells)
    page.goto(address.replace("start_here.ipynb", "chapters/predict.ipynb") + "&reset")
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    notebook = page.get_by_label("predict.ipynb")  # others are open, too
    notebook.get_by_text("import lab").click()
    page.keyboard.press("Shift+Enter")
    page.get_by_text("Choose a, b or c.").wait_for()
    outcome = notebook.get_by_text("There is no response.")
    notebook.get_by_text("prediction_1.reply()").click()
    page.keyboard.press("Shift+Enter")
    page.get_by_text("Predict first: ").wait_for()
    expect(outcome).to_be_hidden()
    expect(notebook.get_by_role("heading", name="Your lines")).to_be_hidden()
    expect(notebook.get_by_role("heading", name="The next part")).to_be_visible()

    page.locator(".course-choices input").first.focus()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Space")
    page.get_by_text("You predict b. Run the next cell.").wait_for()
    assert page.get_by_role("radio", name=re.compile(r"^b\) ")).is_checked()
    page.get_by_role("radio", name=re.compile(r"^c\) ")).click()
    page.get_by_text("You predict c. Run the next cell.").wait_for()
    require_accessible(page, OUTPUTS)

    notebook.get_by_text("prediction_1.reply()").click()
    page.keyboard.press("Shift+Enter")
    reply = page.get_by_text(re.compile(r"You predicted c: \w+"))  # which one c is, your number says
    reply.wait_for()
    assert reply.evaluate("pre => getComputedStyle(pre).wordBreak") == "normal"
    expect(outcome).to_be_visible()
    expect(notebook.get_by_role("heading", name="Your lines")).to_be_visible()
    expect(notebook.get_by_text("It printed more.")).to_be_hidden()
    notebook.get_by_text("print('experiment', 2)").click()
    page.keyboard.press("Shift+Enter")
    notebook.get_by_text("experiment 2").wait_for()
    expect(notebook.get_by_text("It printed more.")).to_be_visible()
    assert notebook.locator(".jp-CodeCell .cm-lineWrapping").count() > 0


def restart_kernel(page: Page) -> None:
    page.get_by_role("menuitem", name="Kernel", exact=True).click()
    page.get_by_text("Restart Kernel…", exact=True).first.click()
    page.get_by_role("button", name="Confirm Kernel Restart").click()


def test_arrow_keys_stay_in_their_question_and_escape_leads_back_to_its_cell(
    page: Page, folder: Path, address: str
) -> None:
    cells = [
        new_code_cell(f'{also}lab.quiz("services", {n})') for n, also in ((1, "import lab\n\n"), (2, ""))
    ]
    write(folder / TOP / "chapters" / "questions.ipynb", new_code_cell("1"), *cells)
    open_chapter(page, address, "questions")
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_text("Run All Cells", exact=True).click()
    first, second = (page.get_by_role("radiogroup", name=f"Question {number}.") for number in (1, 2))
    last = second.get_by_role("radio").last
    last.press("Space")
    page.keyboard.press("ArrowUp")
    for _ in range(3):  # to the last answer again, to the first, and to the one after it
        page.keyboard.press("ArrowDown")
    checked = "answers => answers.map(answer => answer.checked)"
    assert second.get_by_role("radio").evaluate_all(checked) == [False, False, True]  # chosen by Space only
    page.keyboard.press("Space")
    expect(second.get_by_role("radio").nth(1)).to_be_checked()
    assert first.get_by_role("radio").evaluate_all(checked) == [False] * 3
    page.keyboard.press("Escape")
    page.get_by_text("Mode: Command").wait_for()
    expect(page.locator(".jp-Cell:focus")).to_contain_text("Question 2.")
    page.keyboard.press("ArrowUp")
    expect(page.locator(".jp-Cell.jp-mod-active:visible")).to_contain_text("Question 1.")

    restart_kernel(page)
    output = page.locator(".jp-OutputArea-output:has(> .jupyter-widgets-disconnected)").last
    output.wait_for()
    advice = output.evaluate("output => getComputedStyle(output, '::after').content")
    assert "run the first code cell" in advice
    icons = "parts => parts.map(part => getComputedStyle(part, '::before').display)"
    assert set(output.locator(".jupyter-widgets-disconnected").evaluate_all(icons)) == {"none"}

    page.locator(".jp-CodeCell:visible").last.click()
    page.keyboard.press("Control+Enter")
    page.get_by_text("NameError: name 'lab' is not defined").wait_for()
    unrun = page.locator(".course-unrun .jp-OutputArea")
    shown_advice = "outputs => outputs.map(output => getComputedStyle(output, '::after').content)"
    assert "run that cell first" in unrun.evaluate_all(shown_advice)[0]
    page.keyboard.press("Control+a")
    page.keyboard.press("b")
    page.keyboard.press("Enter")
    page.keyboard.type("%%gap march.py")
    page.keyboard.press("Control+Enter")
    expect(unrun).to_have_count(2)


def test_a_self_check_and_submit_save_the_notebook_that_they_read(
    page: Page, folder: Path, address: str
) -> None:
    notebook = folder / TOP / "exercises/patterns/patterns.ipynb"
    content = nbformat.read(notebook, as_version=4)
    cells = [cell for cell in content.cells if cell.id in ("solution", "self-check")]
    cells.append(new_code_cell("import lab\n\n!course submit patterns"))
    nbformat.write(new_notebook(cells=cells, metadata=content.metadata), notebook)
    page.goto(address.replace("start_here.ipynb", "exercises/patterns/patterns.ipynb") + "&reset")
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    shown = page.get_by_label("patterns.ipynb")
    shown.get_by_text("if __name__").click()
    page.keyboard.press("End")
    page.keyboard.type("  # not saved yet")
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_text("Run All Cells", exact=True).click()
    page.get_by_text("Next: mend what the first failed check names").wait_for()
    expect(page.get_by_text("is saved with another program")).to_have_count(0)
    assert "not saved yet" in notebook.read_text()
    require_saved(page)
    assert "Next: mend what the first failed check names" in notebook.read_text()

    shown.get_by_text("if __name__").click()
    page.keyboard.press("End")
    page.keyboard.type(", nor is this")
    shown.get_by_text("!course submit patterns").click()
    page.keyboard.press("Control+Enter")
    page.get_by_text("it replaces another program").wait_for()
    assert "nor is this" in (folder / TOP / "hand_in/patterns.ipynb").read_text()
    failed = page.locator(".course-verdicts details[open]").first
    assert "failed: Each of the twelve situations" in failed.inner_text()
    in_both_themes(page)
    failed.get_by_role("link", name="Topic, service or action?").click()
    lesson = page.get_by_role("heading", name="Topic, service or action?")
    expect(lesson).to_be_in_viewport(timeout=1000 * TIMEOUT)
    expect(page.locator(".jp-Cell.jp-mod-active:visible")).to_contain_text("Topic, service or action?")


def test_questions_plots_and_drawings_suit_both_themes(page: Page, folder: Path, address: str) -> None:
    drawing_in_text = new_markdown_cell("![A deadlock](images/deadlock.svg)")
    write(folder / TOP / "chapters" / "outputs.ipynb", drawing_in_text, *map(new_code_cell, OTHER_OUTPUTS))
    page.goto(address.replace("start_here.ipynb", "chapters/outputs.ipynb") + "&reset")
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_text("Run All Cells", exact=True).click()
    page.get_by_text("GapError: merged.py").first.wait_for()
    in_both_themes(page, left_out=UNNAMED_SLIDER)
    ended = page.get_by_text("model not found")
    assert "Run the first code cell" in ended.evaluate("ended => getComputedStyle(ended, '::after').content")
    assert page.locator(".jp-OutputArea-child:visible", has=page.locator("pre:empty")).count() == 0
    for drawing in page.locator(".course-drawing, .jp-RenderedMarkdown img").all():
        assert "invert" in drawing.evaluate("drawing => getComputedStyle(drawing).filter")
    wide = page.locator("svg.course-drawing", has_text="Wide")
    assert wide.evaluate(
        "svg => svg.getBoundingClientRect().width >= svg.viewBox.baseVal.width"
    )  # no small letters
    assert wide.locator("xpath=..").evaluate("output => output.scrollWidth > output.clientWidth")
    page.get_by_role("group", name="Wide").press("ArrowRight")
    page.wait_for_function("document.activeElement.scrollLeft > 0")
    frame = {found["id"] for found in violations(page).response["violations"]}
    stated = (PROJECT / "docs/accessibility.md").read_text(encoding="utf-8")
    assert {rule for rule in frame if f"`{rule}`" not in stated} == set()  # what JupyterLab itself lacks


def test_the_keyboard_alone_leads_from_the_start_page_to_a_handed_in_exercise(
    page: Page, folder: Path
) -> None:
    exercise = folder / TOP / "exercises/patterns"
    shutil.copy(PROJECT / "exercises/patterns/patterns.ipynb", exercise)  # another test may have changed it
    press = page.keyboard.press
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    run_cell(page, "lab.show_progress()")
    page.get_by_text("Nothing done yet").or_(page.get_by_text("Go on with")).wait_for()
    press("ArrowUp")
    link = page.get_by_role("row").get_by_role("link", name="patterns")
    for _ in range(20):
        press("Tab")
        if link.evaluate("link => link === document.activeElement"):
            break
    press("Enter")
    page.get_by_role("heading", name="Topic, service or action?").wait_for()

    cells = nbformat.read(exercise / "patterns.ipynb", as_version=4).cells
    program = next(cell.source for cell in cells if cell.id == "solution")
    go_to_cell(page, "%%writefile patterns.py")
    press("Enter")
    for _ in program.partition("# YOUR CODE HERE")[0].splitlines()[1:]:
        press("ArrowDown")
    press("End")
    for number, (pattern, reason) in enumerate(ANSWERS, start=1):
        press("Enter")
        page.keyboard.type(f'{number}: ("{PATTERNS[pattern]}", "{reason}"),')
    press("Shift+Enter")
    page.get_by_text(re.compile("riting patterns.py")).wait_for()
    run_cell(page, 'checked = self_check("patterns")')
    page.get_by_text("7 of 7 points").wait_for()

    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    require_saved(page)  # by the self-check, which takes the focus for a moment
    press("b")  # a cell below
    press("Enter")
    page.get_by_text("Mode: Edit").wait_for()
    page.keyboard.type("!course submit patterns")
    press("Shift+Enter")
    page.get_by_text("Next: hand in what is in").wait_for()
    handed_in = folder / TOP / "hand_in/patterns.ipynb"
    assert '12: ("action", "c")' in handed_in.read_text().replace('\\"', '"')


def go_to_cell(page: Page, words: str) -> None:
    """Go down from cell to cell until the one with these words is active."""
    for _ in range(40):
        if page.locator(".jp-Cell.jp-mod-active:visible", has_text=words).count():
            return
        page.keyboard.press("ArrowDown")
    raise AssertionError(f"no cell below contains {words!r}")


def run_cell(page: Page, words: str) -> None:
    """Go down to the cell with these words, and run it."""
    go_to_cell(page, words)
    page.keyboard.press("Shift+Enter")


def in_both_themes(page: Page, **options: Mapping[str, str]) -> None:
    """Require that the outputs are accessible in JupyterLab's light theme and in its dark one, which stays."""
    for theme, is_light in (("JupyterLab Light", "true"), ("JupyterLab Dark", "false")):
        page.get_by_role("menuitem", name="Settings", exact=True).click()
        page.locator(".lm-Menu-item", has_text="Theme").first.hover()
        page.locator(".lm-Menu-item", has_text=theme).first.click()
        page.locator(f'body[data-jp-theme-light="{is_light}"]').wait_for(state="attached")
        require_accessible(page, OUTPUTS, **options)


def write(notebook: Path, *cells: nbformat.NotebookNode) -> None:
    nbformat.write(new_notebook(cells=cells, metadata=KERNEL), notebook)


def open_chapter(page: Page, address: str, name: str) -> None:
    """Open a chapter in a page without the tabs of earlier ones."""
    page.goto(address.replace("start_here.ipynb", f"chapters/{name}.ipynb") + "&reset")
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()


def run_first_cell(page: Page, name: str) -> None:
    page.get_by_label(f"{name}.ipynb").get_by_text("import lab").click()
    page.keyboard.press("Shift+Enter")


def require_saved(page: Page) -> None:
    """Require that the tab of the notebook soon shows no unsaved change."""
    expect(page.locator(".lm-DockPanel .lm-mod-current.jp-mod-dirty")).to_have_count(
        0, timeout=1000 * TIMEOUT
    )


def panels(page: Page) -> Locator:
    return page.locator(".jp-SideBar.jp-mod-right .lm-TabBar-tab", has_text="Robot")


def seen(page: Page) -> np.ndarray:
    """The present picture of the robot, (height, width, 3)."""
    screenshot = page.locator(PICTURE).screenshot()
    return np.asarray(Image.open(io.BytesIO(screenshot)).convert("RGB")).astype(int)
