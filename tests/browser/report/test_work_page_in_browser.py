"""The page to show, opened from disk: nothing is loaded, both themes can be read, a phone needs no scrolling."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import pytest
from playwright.sync_api import sync_playwright

from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from autograder.recording.recorder import Recorder
from autograder.work_page import write_work_page
from chromium import CHROMIUM, OFFLINE, needs_chromium
from falls import accepts, exercise, judged, simulated, walk

PROGRAM = f'class Walker:  # <img src=x onerror=document.title="run">\n    """{"a" * 300}"""\n'
CONTRAST = 4.5  # at least, of text on its background (WCAG 2.1 AA)
# The lowest contrast of the program's letters, without white space, on their background.
LOWEST = """() => {
  const light = colour => colour.match(/[\\d.]+/g).slice(0, 3).map(value => value / 255)
    .map(value => value <= 0.03928 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4)
    .reduce((sum, value, index) => sum + value * [0.2126, 0.7152, 0.0722][index], 0);
  const paper = light(getComputedStyle(document.querySelector('.program')).backgroundColor);
  return Math.min(...[...document.querySelectorAll('.program, .program span:not(.w)')].map(letters => {
    const ink = light(getComputedStyle(letters).color);
    return (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
  }));
}"""

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    run = walk(postures=simulated()[0])
    recorder = Recorder(exercise(), for_students=True)
    verdict = judged(accepts, run)
    recorder.add(verdict, [run])
    file = tmp_path_factory.mktemp("shown") / "walk_to.html"
    submission = Submission("walk_to", "you", {"walk_to.py": PROGRAM})
    write_work_page(file, submission, Grade("walk_to", "you", "namespaces", [verdict], seed=0), recorder)
    return file


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_opens_by_itself_and_can_be_read(file: Path, scheme: Literal["light", "dark"]) -> None:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=OFFLINE)
        page = browser.new_page(viewport={"width": 390, "height": 800}, color_scheme=scheme)
        wanted: list[str] = []
        page.on("request", lambda request: wanted.append(request.url))
        page.goto(file.as_uri())
        film = page.get_by_role("img", name="The robot, with the events")
        assert film.evaluate("film => film.decode().then(() => film.naturalWidth)") == 480
        assert page.evaluate(LOWEST) >= CONTRAST
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        page.get_by_text("Film of the scenario").click()
        assert not film.is_visible()
        assert page.title() == "Walk to a pose"
        browser.close()
    assert {url for url in wanted if not url.startswith("data:")} == {file.as_uri()}
