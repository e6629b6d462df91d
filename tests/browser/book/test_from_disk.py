"""The book opened from the disk, without a network: formulas, pictures, folded replies, search."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_output
from playwright.sync_api import Page, sync_playwright

from accessibility import require_accessible
from autograder.classroom.book.site import make_site
from chromium import CHROMIUM, OFFLINE, needs_chromium
from ros_runtime.project import PROJECT

DOT = "data:image/webp;base64,UklGRhoAAABXRUJQVlA4TA0AAAAvAAAAEAcQERGIiP4HAA=="

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the book, with a film in the first code cell of chapter 1."""
    folder = tmp_path_factory.mktemp("book")
    run = nbformat.read(PROJECT / "chapters/01_robot_and_graph.ipynb", as_version=4)
    first = next(cell for cell in run.cells if cell.cell_type == "code")
    first.outputs = [
        new_output("display_data", {"text/html": f'<figure><img src="{DOT}" alt="film"></figure>'})
    ]
    return make_site(folder / "site", folder / "work", {"01_robot_and_graph": run}).parent


@pytest.fixture
def page(site: Path) -> Iterator[Page]:
    """A browser page that can load only files of the book."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=OFFLINE)
        page = browser.new_page(viewport={"width": 1250, "height": 1000})
        wanted: list[str] = []
        problems: list[str] = []
        page.on("request", lambda request: wanted.append(request.url))
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.goto(f"file://{site}/index.html")
        yield page
        browser.close()
    assert [url for url in wanted if not url.startswith((f"file://{site}/", "data:"))] == []
    assert problems == []


def test_a_chapter_has_its_formulas_and_pictures_and_unfolds_a_reply(page: Page) -> None:
    page.get_by_role("link", name="1 · The robot and its graph").first.click()
    formula = page.locator("math[display=block]").first.bounding_box()
    assert formula
    assert formula["height"] > 10
    loaded = "images => images.every(image => image.complete && image.naturalWidth > 0)"
    page.get_by_alt_text("film").wait_for()
    assert page.locator("main img, article img").evaluate_all(loaded)

    reply = page.locator(".question details").first
    assert not reply.locator("p").is_visible()
    reply.locator("summary").click()
    assert reply.locator("p").is_visible()


def test_the_search_finds_a_word_and_the_glossary_leads_to_the_cell(page: Page) -> None:
    page.get_by_role("textbox", name="Search").first.fill("deadlock")
    page.keyboard.press("Enter")
    page.locator("#search-results").get_by_role("link", name="Glossary").click()
    page.get_by_role("row").filter(has_text="idempotent").get_by_role("link").click()
    page.wait_for_url("**/chapters/03*.html#*")
    cell = page.url.partition("#")[2]
    assert page.locator(f"#{cell}").bounding_box()


def test_the_page_of_each_week_prints_on_one_sheet(site: Path, page: Page) -> None:
    weeks = sorted((site / "chapters").glob("week_*.html"))
    assert {week.stem.removeprefix("week_") for week in weeks} >= {"02_services", "07_cancel_and_preempt"}
    for week in weeks:
        page.goto(week.as_uri())
        assert page.locator("article img").count() == 1
        assert page.locator("article li").count() >= 3, week
        assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4"))) == 1, week


def test_its_pages_meet_wcag_2_1_aa(site: Path, page: Page) -> None:
    for name in (
        *("index", "search", "chapters/01_robot_and_graph", "chapters/week_02_services"),
        *("exercises/patterns/patterns", "docs/grading", "docs/accessibility"),
    ):
        page.goto((site / f"{name}.html").as_uri())
        require_accessible(page)
