"""An instructor marks in a browser: an essay, and a student's answers to questions about the student's own program."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from playwright.sync_api import Page, sync_playwright

from accessibility import require_accessible
from autograder.classroom.nbgrader_bridge.gradebook import CourseGradebook, Entry
from autograder.classroom.questions.formgrader import assignment_of, enter_questions
from autograder.classroom.questions.question import Part, Question, Sheet
from autograder.engine.essay import load_essay, unmarked_grade
from chromium import CHROMIUM, OFFLINE, needs_chromium

TIMEOUT = 90.0  # s, for each thing a busy machine has to do
SOLUTIONS = Path(__file__).resolve().parents[3] / "solutions"
NAME = "arm_architecture"
ESSAY = load_essay(NAME)
ENTRY = Entry(
    unmarked_grade(ESSAY, "anna"), {f"{NAME}.txt": (SOLUTIONS / NAME / "marked/weak.txt").read_text()}
)
ASKED = Question("change", 2, "", (Part("Suppose line 2, `a < b`, were missing.", "clause 4: no answer"),))
SHEET = Sheet("anna", "walk_to", "import rclpy\na < b\n", (ASKED,))
POINTS = {"graph": "0", "pattern": "1", "type": "0", "qos": "0", "rate": "1.5", "failure": "0", "safety": "0"}

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A course folder in which one essay is to be marked."""
    folder = tmp_path_factory.mktemp("course") / "graded"
    assert CourseGradebook(folder, SOLUTIONS).enter(ENTRY) is None
    return folder


@pytest.fixture(scope="module")
def address(course: Path) -> Iterator[str]:
    """The address at which Jupyter serves that folder, started as `course grade` says."""
    options = ["--no-browser", "--allow-root", "--ServerApp.port=0", "--IdentityProvider.token="]
    with subprocess.Popen(
        [sys.executable, "-m", "jupyter", "lab", *options],
        cwd=course,
        env={**os.environ, "JUPYTER_CONFIG_DIR": str(course / "jupyter"), "HOME": str(course)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    ) as server:
        assert server.stderr
        line = next(line for line in server.stderr if "http://127.0.0.1" in line)
        yield line[line.index("http://") :].strip().partition("/lab")[0]
        started = psutil.Process(server.pid).children(recursive=True)
        server.terminate()
        server.communicate(timeout=TIMEOUT)
        psutil.wait_procs(started, timeout=TIMEOUT)


@pytest.fixture
def page(address: str) -> Iterator[Page]:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=OFFLINE)
        page = browser.new_page(viewport={"width": 1200, "height": 1000})
        page.set_default_timeout(1000 * TIMEOUT)
        yield page
        browser.close()


def give_points(page: Page, cell: str, points: str) -> None:
    box = page.locator(f"input#{cell}.needs_manual_grade")
    box.wait_for()
    assert box.input_value() == ""
    box.fill(points)
    with page.expect_response(lambda answer: "/api/grade/" in answer.url and answer.ok):
        box.dispatch_event("change")


def test_questions_about_a_program_are_marked_beside_their_keys(
    page: Page, address: str, course: Path, tmp_path: Path
) -> None:
    assert enter_questions(course, [SHEET], tmp_path, 2) == 0
    name = assignment_of("walk_to")
    page.goto(f"{address}/formgrader/gradebook/{name}/{name}")
    page.get_by_role("link", name="Submission #1").click()
    page.get_by_text("were missing.").wait_for()
    page.get_by_text("clause 4: no answer").wait_for()
    page.get_by_text("Ask one of your own.").wait_for()
    for cell, points in (("question_1", "1.5"), ("question_2", "0")):
        give_points(page, cell, points)
    assert enter_questions(course, [SHEET], tmp_path, 2) == 1
    page.goto((course / "feedback" / "anna" / name / f"{name}.html").as_uri())
    page.get_by_text("(Score: 1.5 / 4.0)").wait_for()
    assert page.locator("#toc a").all_inner_texts() == ["Answer 1", "Answer 2"]
    assert page.get_by_text("clause 4: no answer").count() == 0
    require_accessible(page)


def test_an_essay_is_opened_marked_and_given_back(page: Page, address: str, course: Path) -> None:
    page.goto(f"{address}/formgrader/gradebook/{NAME}/{NAME}")
    page.get_by_role("link", name="Submission #1").click()

    page.get_by_text("arm_interfaces/action/EmergencyStop").first.wait_for()  # the work
    drawing = page.locator('img[src^="data:image/svg+xml"]')
    drawing.wait_for()
    assert drawing.evaluate("image => image.naturalWidth") > 500
    for criterion in ESSAY.criteria:
        give_points(page, criterion.id, POINTS[criterion.id])
    comment = page.locator("textarea#safety-comment")
    comment.fill("What if the screen hangs?")
    with page.expect_response(lambda answer: "/api/comment/" in answer.url and answer.ok):
        comment.dispatch_event("change")
    assert page.locator("input.needs_manual_grade").count() == 0

    gradebook = CourseGradebook(course, SOLUTIONS)  # as `course grade` does when it is run again
    feedback = gradebook.enter(ENTRY)
    assert gradebook.as_marked(ENTRY.grade).score == 2.5
    assert feedback
    page.goto(feedback.as_uri())
    page.get_by_text("(Score: 2.5 / 20.0)").wait_for()
    require_accessible(page)
    titles = [criterion.title for criterion in ESSAY.criteria]
    assert page.locator("#toc a").all_inner_texts() == [*titles, f"Comment on: {titles[-1]}"]
    page.get_by_text("What if the screen hangs?").wait_for()
