"""The glossary and the cheat sheet are complete and correct, and all pages state the same minutes."""

from __future__ import annotations

import os
import re
from functools import cache
from pathlib import Path

import nbformat
import pytest
import rclpy
from rclpy.action import ActionClient
from rclpy.action.client import ClientGoalHandle
from rclpy.action.server import ServerGoalHandle
from rclpy.client import Client
from rclpy.node import Node

import lab
from autograder.classroom.archives.student_bundle import README, SHOWN, files_of
from autograder.engine.exercise import exercise_names, load_exercise
from course_cli.app import COMMANDS, FOR_EVERYBODY

ROOT = Path(__file__).resolve().parents[3]
DOCS = ROOT / "docs"
CELL_LINK = re.compile(r"\[(\d+\w?): [^\]]+\]\(\.\./chapters/([\w]+)\.ipynb#cell-id=([a-z0-9-]+)\)")
WORDS = (
    "node, graph, namespace, topic, message, publisher, subscription, QoS, reliability, durability, "
    "depth, service, server, client, request, response, future, timeout, deadline, idempotent, action, "
    "goal, accept, reject, feedback, result, cancel, preempt, abort, executor, reentrant, spin, deadlock, "
    "parameter, frame, odom, map, base_link, quaternion, interface, package, discovery, DDS, RMW, lease, "
    "remap, transient local, latched, goal handle, terminal state, callback group, relative name, type "
    "hash "
)


@cache
def cells(chapter: str) -> set[str]:
    path = ROOT / f"chapters/{chapter}.ipynb"
    return {cell.id for cell in nbformat.read(path, as_version=4).cells} if path.exists() else set()


def rows(page: Path) -> list[list[str]]:
    """The cells of a page's tables, without the header rows."""
    lines = [line for line in page.read_text().splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def code(column: int) -> list[str]:
    """The code in one column of the cheat sheet, without backticks."""
    return [
        snippet
        for row in rows(DOCS / "cheat_sheet.md")
        if len(row) > column
        for snippet in re.findall(r"`([^`]+)`", row[column])
    ]


def test_the_glossary_has_every_word_and_shows_where_it_is_taught() -> None:
    entries = [row for row in rows(DOCS / "glossary.md") if row[0] != "Word"]
    words = {word for row in entries for part in row for word in re.findall(r"\*\*(.+?)\*\*", part)}
    assert set(WORDS.strip().split(", ")) - {word.partition(" (")[0] for word in words} == set()
    for row in entries:
        found = CELL_LINK.search(row[2])
        assert found, row[0]
        number, chapter, cell = found.groups()
        assert chapter.lstrip("0").startswith(f"{number}_"), row[0]
        assert cell in cells(chapter), f"{row[0]}: {chapter} has no cell {cell}"
        assert 1 <= len(re.findall(r"[.?]( |$)", row[1])) <= 4, row[0]


def test_the_cheat_sheet_has_every_function_of_the_lab_and_no_other() -> None:
    named = {name for text in code(1) for name in re.findall(r"\blab\.(\w+)", text)}
    assert named == {name for name in lab.__all__ if name[0].islower()}


def test_its_ros2_commands_exist() -> None:
    known = set(re.findall(r"^\| `(\w+ \w+)", (DOCS / "ros2_commands.md").read_text(), re.MULTILINE))
    used = {verb for text in code(2) for verb in re.findall(r"\bros2 (\w+ \w+)", text)}
    assert len(used) > 15
    assert used - known == set()


@pytest.mark.parametrize(
    ("owner", "classes"),
    [
        ("node", (Node,)),
        ("client", (Client, ActionClient)),
        ("goal_handle", (ServerGoalHandle, ClientGoalHandle)),
        ("rclpy", (rclpy,)),
    ],
)
def test_its_rclpy_names_exist(owner: str, classes: tuple[object, ...]) -> None:
    named = {name for text in code(3) for name in re.findall(rf"\b{owner}\.(\w+)", text)}
    assert named
    assert {name for name in named if not any(hasattr(one, name) for one in classes)} == set()


def minutes_of_the_start_page() -> dict[str, int]:
    """The minutes of each chapter, by file, and of each exercise, as chapters/README.md says them."""
    minutes = {}
    for row in rows(ROOT / "chapters/README.md"):
        if chapter := re.search(r"\((\w+)\.ipynb\)", row[0]):
            minutes[chapter[1]] = int(row[1])
            minutes |= {name: int(number) for name, number in re.findall(r"\[(\w+)\]\S+ \((\d+)\)", row[2])}
    return minutes


def weeks() -> list[list[str]]:
    """The rows of the instructors' table of weeks; a chapter may have two, such as "8, 9"."""
    return [row for row in rows(DOCS / "for_instructors.md") if re.fullmatch(r"\d+(, \d+)?", row[0])]


def test_instructors_read_the_same_minutes_as_students() -> None:
    students = minutes_of_the_start_page()
    titles = {re.sub(r"[\[\]]|\(.*?\)", "", row[0]): row[1] for row in rows(ROOT / "chapters/README.md")}
    instructors = {row[1]: row for row in weeks()}
    assert {title for title in titles if title[0].isdigit()} == set(instructors)
    for title, row in instructors.items():
        assert row[2] == titles[title], title
        for exercise, number in re.findall(r"(\w+) \((\d+)\)", row[3]):
            assert students.pop(exercise) == int(number), exercise
    assert [name for name in students if not name[0].isdigit()] == []


def test_instructors_read_how_many_points_are_hidden() -> None:
    page = (DOCS / "for_instructors.md").read_text()
    stated = {
        name: (int(shown), int(kept)) for name, shown, kept in re.findall(r"`(\w+)` \| (\d+) \| (\d+)", page)
    }
    for name in exercise_names():
        checks = load_exercise(name, hidden=True).checks
        assert stated.pop(name) == tuple(
            sum(check.points for check in checks if check.hidden is hidden) for hidden in (False, True)
        )
    assert stated == {}


def test_a_notebook_that_says_how_long_it_takes_says_what_the_start_page_says() -> None:
    for name, minutes in minutes_of_the_start_page().items():
        chapter = ROOT / f"chapters/{name}.ipynb"
        path = chapter if chapter.exists() else ROOT / f"exercises/{name}/{name}.ipynb"
        text = path.read_text()
        if said := re.search(r"Reading: (\d+) minutes\. Doing: (\d+) minutes", text):
            assert int(said[1]) + int(said[2]) == minutes, f"{name}: reading and doing"
        if said := re.search(r"About (\d+) minutes", text):
            assert int(said[1]) == minutes, name


@pytest.mark.parametrize("page", sorted(DOCS.glob("*.md")), ids=lambda page: page.stem)
def test_the_links_of_a_page_lead_somewhere(page: Path) -> None:
    # it becomes the README of the students' archive
    base = ROOT if page.stem == "for_students" else page.parent
    links = re.findall(r"\]\(([^)\s#]+)", page.read_text())
    assert [link for link in links if "://" not in link and not (base / link).exists()] == []


def pages_of_the_archive() -> dict[Path, str]:
    """The text of each page and notebook that students see, by its path in their archive."""
    files = {path.relative_to(ROOT): path for path in files_of(ROOT, SHOWN)}
    files |= {path.relative_to(ROOT): path for path in ROOT.glob("exercises/*/*.ipynb")}
    files[Path("README.md")] = ROOT / README
    return {name: text_of(path) for name, path in files.items() if path.suffix in (".md", ".ipynb")}


def text_of(path: Path) -> str:
    if path.suffix == ".md":
        return path.read_text()
    return "\n".join(cell.source for cell in nbformat.read(path, as_version=4).cells)


def links_of(name: Path, text: str) -> set[Path]:
    """The files of this project to which a page links, or which it shows."""
    links = re.findall(r"\]\(([^)\s#]+)", text)
    return {Path(os.path.normpath(name.parent / link)) for link in links if "://" not in link}


def test_the_pages_of_the_students_archive_link_only_to_what_it_contains() -> None:
    pages = pages_of_the_archive()
    shown = {*pages, *(path.relative_to(ROOT) for path in files_of(ROOT, SHOWN))}
    shown |= {folder for path in shown for folder in path.parents}
    of_pages = {name: text for name, text in pages.items() if name.suffix == ".md"}
    missing = [
        (str(name), str(link)) for name, text in of_pages.items() for link in links_of(name, text) - shown
    ]
    assert missing == []


def test_the_students_archive_contains_only_what_its_pages_show() -> None:
    linked = {link for name, text in pages_of_the_archive().items() for link in links_of(name, text)}
    linked |= {Path(name) for name in re.findall(r"`(docs/\w+\.md)`", (ROOT / README).read_text())}
    shown = {path for path in files_of(ROOT, SHOWN) if path.is_relative_to(DOCS)}
    assert len(shown) > 10
    assert {path.relative_to(ROOT) for path in shown} - linked == set()


def test_the_pages_of_the_students_archive_name_only_commands_that_it_has() -> None:
    for_others = "|".join(name for name, command in COMMANDS.items() if command.folder != FOR_EVERYBODY)
    students = {name for name, command in COMMANDS.items() if command.folder == FOR_EVERYBODY}
    named: dict[str, str] = {}
    for page, text in pages_of_the_archive().items():
        named |= dict.fromkeys(re.findall(r"[/!`]course ([a-z]\w*)", text), str(page))
        named |= dict.fromkeys(re.findall(rf"`({for_others})(?: -[^`]*)?`", text), str(page))
    assert {"lab", "check", "submit"} <= set(named)
    assert {name: page for name, page in named.items() if name not in students} == {}
