"""The whole book, made without running its chapters: every page exists, and nothing is loaded from other sites."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest

from autograder.classroom.book.site import make_site, parts_of
from ros_runtime.course_error import CommandFailed
from ros_runtime.project import PROJECT


class Page(HTMLParser):
    """A page's ids, its links, and the files that it loads."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = {name: value or "" for name, value in attrs}
        self.ids.add(named.get("id", ""))
        if tag == "a":
            self.links.append(named.get("href", ""))
        elif tag in {"script", "img", "link", "iframe", "video", "source"}:
            self.loaded += [named[name] for name in ("src", "href") if name in named]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("book")
    return make_site(folder / "site", folder / "work", {}).parent


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[Path, Page]:
    return {file: Page(file) for file in site.rglob("*.html")}


def test_every_chapter_exercise_and_doc_has_its_page(site: Path) -> None:
    wanted = {page.with_suffix(".html").as_posix() for part in parts_of(PROJECT).values() for page in part}
    assert {"docs/glossary.html", "docs/cheat_sheet.html", "docs/for_instructors.html"} <= wanted
    assert {path.stem for path in (PROJECT / "chapters").glob("*.ipynb")} <= {
        Path(page).stem for page in wanted
    }
    assert [page for page in wanted if not (site / page).exists()] == []
    docs = {path.stem for path in (PROJECT / "docs").glob("*.md")} - {"for_students"}
    assert docs == {path.stem for path in (site / "docs").glob("*.html")}


def test_nothing_that_a_page_loads_comes_from_another_site(site: Path, pages: dict[Path, Page]) -> None:
    for file, page in pages.items():
        for address in page.loaded:
            if not address.startswith("data:"):
                assert (file.parent / urldefrag(address)[0].partition("?")[0]).exists(), (file, address)
    styles = "".join(path.read_text() for path in site.rglob("*.css"))
    assert re.findall(r"(?:url\(|@import )['\"]?(?:https?:)?//", styles) == []


def test_every_link_inside_the_book_leads_to_a_page_and_a_place_in_it(pages: dict[Path, Page]) -> None:
    lost = []
    for file, page in pages.items():
        for link in page.links:
            address, fragment = urldefrag(unquote(link))
            if "://" in address or link in {"", "#"}:
                continue
            target = (file.parent / address).resolve() if address else file
            if target not in pages or (fragment and fragment not in pages[target].ids):
                lost.append(f"{file.name}: {link}")
    assert lost == []


def test_formulas_are_mathml(site: Path) -> None:
    chapter = (site / "chapters/01_robot_and_graph.html").read_text()
    assert '<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">' in chapter
    assert "<msqrt>" in chapter
    assert "\\sqrt" not in chapter
    assert "MathJax" not in chapter


def test_the_search_finds_words_of_chapters_and_of_the_glossary(site: Path) -> None:
    index = (site / "searchindex.js").read_text()
    assert '"deadlock"' in index or "deadlock:" in index
    assert "docs/glossary" in index


def test_warnings_of_sphinx_are_reported(tmp_path: Path) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs/glossary.md").write_text("# Glossary\n\n![gone](images/gone.png)\n")
    with pytest.raises(CommandFailed, match=r"(?s)glossary\.md:3.*gone\.png"):
        make_site(tmp_path / "site", tmp_path / "work", {}, project=tmp_path)
