"""The pages of a graded class, opened from disk: by keyboard, in dark mode, on a phone, without a network."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, sync_playwright

from accessibility import require_accessible
from autograder.classroom.pages.history import with_day
from autograder.classroom.pages.pages import write_class_page, write_student_page, write_submission_pages
from autograder.classroom.pages.plots import bars_svg
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.rendering import Section, write_page
from chromium import CHROMIUM, OFFLINE, needs_chromium

HOSTILE = "<img src=x onerror=document.title='run'>"
UNFOLD = "all => all.forEach(summary => { summary.parentElement.open = true; })"
PHONE = {"width": 390, "height": 800}

pytestmark = needs_chromium


def grade(student: str, status: str, exercise: str) -> Grade:
    points = 4 if status == "passed" else 0
    long = f"{HOSTILE} " + "a_long_word_without_a_break" * 20
    return Grade(
        exercise,
        student,
        "namespaces",
        [
            CheckVerdict("appears", "The node offers walk_to", "passed", 1, 1),
            CheckVerdict("walks", "It walks", status, points, 4, long, long, long, 3.0, f"  1.00 s  {long}"),  # type: ignore[arg-type]
        ],
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pages of a class of two students, one of whom failed a check in each of five exercises."""
    folder = tmp_path_factory.mktemp("graded")
    drawing = bars_svg({"0 to 9": 3, "10": 1}, title="How fast", across="speed", up="walks")
    grades = [
        grade(student, status, f"exercise_{number}")
        for number in range(5)
        for student, status in (("anna", "passed"), (HOSTILE, "failed"))
    ]
    for each in grades:
        write_submission_pages(folder, each, {"walks": [drawing]})
    write_student_page(folder, "anna", [each for each in grades if each.student == "anna"])
    earlier = with_day((), "2026-10-05", grades)
    write_class_page(folder, grades, ["bo/: no file"], {"when": "today"}, earlier)
    sections = [Section(each.student, each, {"walks": [drawing]}) for each in grades[:2]]
    write_page(folder / "report.html", title="Report", introduction="Two submissions", sections=sections)
    return folder


@pytest.fixture
def page(folder: Path) -> Iterator[Page]:
    """The class page, in a browser that loads no files and runs no scripts."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=OFFLINE)
        page = browser.new_page(viewport={"width": 1200, "height": 900}, color_scheme="dark")
        wanted: list[str] = []
        page.on("request", lambda request: wanted.append(request.url))
        page.goto((folder / "class.html").as_uri())
        yield page
        assert page.title() != "run"
        browser.close()
    assert all(url.startswith(folder.as_uri()) and url.partition("#")[0].endswith(".html") for url in wanted)


def test_the_keyboard_leads_from_the_class_to_what_happened(page: Page) -> None:
    page.keyboard.press("Tab")
    assert page.locator(":focus").inner_text() == "Skip to the content"
    page.get_by_role("region", name="Less than 60 %").get_by_role("link", name="It walks").first.focus()
    page.keyboard.press("Enter")
    page.wait_for_url("**/instructor/**#walks")
    assert page.get_by_role("row", name="It walks").is_visible()
    drawing = page.get_by_role("img", name="How fast")
    assert not drawing.is_visible()
    page.locator("summary", has_text="what happened").focus()
    page.keyboard.press("Enter")
    assert drawing.is_visible()


def test_dark_mode_has_light_text_and_a_phone_needs_no_horizontal_scrolling(page: Page, folder: Path) -> None:
    brightness = (
        "style => style.match(/\\d+/g).slice(0, 3).reduce((sum, value) => sum + Number(value), 0) / 3"
    )
    for path in sorted(folder.rglob("*.html")):
        page.goto(path.as_uri())
        ink, paper = (
            page.evaluate(f"({brightness})(getComputedStyle(document.body).{name})")
            for name in ("color", "backgroundColor")
        )
        assert ink > 200 > 50 > paper
        page.set_viewport_size(PHONE)
        page.locator("summary").evaluate_all(UNFOLD)
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"], path


def test_every_page_meets_wcag_2_1_aa(page: Page, folder: Path) -> None:
    for path in sorted(folder.rglob("*.html")):
        page.goto(path.as_uri())
        page.locator("summary").evaluate_all(UNFOLD)
        require_accessible(page)
