"""docs/coverage.md is correct: every row names its proofs, and every named cell, check, test and submission exists."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import nbformat
import pytest

from autograder.classroom.audit.known_submission import known_submission
from autograder.engine.essay import load_essay
from autograder.engine.exercise import essay_names, load_exercise
from ros_runtime.course_error import CourseError

ROOT = Path(__file__).resolve().parents[3]
PAGE = (ROOT / "docs/coverage.md").read_text()

DONE = re.findall(
    r"\S+",
    """
000-1 000-2 000-3 000-4 000-5 000-6 000-7 000-8 000-9 000-10 001-1 001-2 001-3 001-4 001-5 001-6 001-7 001-8 001-9 002-1
002-2 002-3 002-4 002-5 003-1 003-2 003-3 003-4 003-5 003-6 003-7 004-1 004-2 004-3 004-4 004-5 004-6 004-7 004-8 M1 M2
M3 M4 M5 M6 M7 M8 M9 M10 M11 M12 M13 M14 M15 M16 M17 M18 M19 M20
""",
)
NOT_BY_NAME = {
    "quiz-7",
    "patterns-choose",
}  # cells whose tests take all quizzes, and the widgets of a run

Row = tuple[str, list[list[str]]]


def rows() -> list[Row]:
    """The rows of the page's tables: the item's name, and the proofs of each column behind what is shown."""
    lines = [line.strip("|").split("|") for line in PAGE.splitlines() if re.match(r"\| [0M]", line)]
    return [(line[0].strip(), [re.findall(r"`([^`]+)`", column) for column in line[2:]]) for line in lines]


ITEMS = [row for row in rows() if row[0][0] == "0"]
MISCONCEPTIONS = [row for row in rows() if row[0][0] == "M"]


def name_of(row: object) -> str | None:
    """The name of a row, for pytest."""
    return row[0] if isinstance(row, tuple) else None


@cache
def cell_ids(notebook: str) -> set[str]:
    """The cells of a chapter, or of an exercise's notebook."""
    chapter = ROOT / f"chapters/{notebook}.ipynb"
    path = chapter if chapter.exists() else ROOT / f"exercises/{notebook}/{notebook}.ipynb"
    return {cell.id for cell in nbformat.read(path, as_version=4).cells}


@cache
def check_ids(exercise: str) -> set[str]:
    """Its checks; of an essay its criteria."""
    if exercise in essay_names():
        return {criterion.id for criterion in load_essay(exercise).criteria}
    return {check.id for check in load_exercise(exercise, hidden=True).checks}


@cache
def source_of(proof: str) -> str:
    """The source of test_file::test, with its decorators."""
    file, test = proof.split("::")
    (path,) = ROOT.glob(f"tests/robot/*/{file}.py")
    sources = [block for block in path.read_text().split("\n\n\n") if f"def {test}(" in block]
    assert len(sources) == 1, proof
    return sources[0]


def require_proof(proof: str) -> None:
    """A proof is CHAPTER#cell or exercise#cell, exercise: check, test_file::test, or exercise/kind/submission."""
    if "#" in proof:
        notebook, cell = proof.split("#")
        assert cell in cell_ids(notebook), proof
    elif "::" in proof:
        assert source_of(proof)
    elif ": " in proof:
        exercise, check = proof.split(": ")
        assert check in check_ids(exercise), proof
    else:
        known_submission(*proof.split("/", 1))


def require_read(cells: list[str], tests: list[str]) -> None:
    """Each cell is one that a test of its row looks at."""
    assert cells
    assert tests
    for cell in (cell.partition("#")[2] for cell in cells):
        assert cell in NOT_BY_NAME or any(f'"{cell}"' in source_of(test) for test in tests), cell


def test_no_finished_row_was_removed() -> None:
    assert [row[0] for row in rows()] == DONE
    assert "*Partial*" not in PAGE


@pytest.mark.parametrize("row", rows(), ids=name_of)
def test_each_name_in_a_row_exists(row: Row) -> None:
    for column in row[1]:
        for proof in column:
            require_proof(proof)


@pytest.mark.parametrize("row", ITEMS, ids=name_of)
def test_an_item_has_a_cell_a_check_and_a_test_that_reads_the_cell(row: Row) -> None:
    cells, checks, tests = row[1]
    assert any(": " in check for check in checks)
    require_read(cells, tests)


@pytest.mark.parametrize("row", MISCONCEPTIONS, ids=name_of)
def test_a_misconception_is_seen_failing_and_is_caught_by_the_checks_that_its_submissions_name(
    row: Row,
) -> None:
    name, (cells, submissions, checks, tests) = row
    require_read(cells, tests)
    caught_by: set[str] = set()
    for submission in submissions:
        known = known_submission(*submission.split("/", 1))
        assert f"({name})" in known.about
        catches = {f"{known.exercise}: {check}" for check in known.caught_by}
        assert catches & set(checks), f"{submission} is caught by {catches}"
        caught_by |= catches
    assert set(checks) <= caught_by


@pytest.mark.parametrize(
    "proof",
    [
        "02_services#no-such-cell",
        "battery_service: no_such_check",
        "test_08_navigation::test_x",
        "a/faulty/none",
    ],
)
def test_a_missing_proof_is_detected(proof: str) -> None:
    with pytest.raises((AssertionError, CourseError)):
        require_proof(proof)


def test_a_cell_that_no_test_reads_is_detected() -> None:
    with pytest.raises(AssertionError, match="m8-run"):
        require_read(
            ["02_services#m8-run"],
            ["test_02_services::test_half_of_the_calls_are_fast_and_the_slowest_is_not"],
        )
