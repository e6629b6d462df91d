"""docs/coverage.md tells the truth: every cell, check, test and submission it names as a proof is there."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import nbformat
import pytest

from autograder.audit.known_submission import HeaderError, known_submission
from autograder.engine.essay import load_essay
from autograder.engine.exercise import essay_names, load_exercise

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


def rows() -> list[list[str]]:
    """The cells of the page's tables, without their headings."""
    lines = [line.strip("|").split("|") for line in PAGE.splitlines() if re.match(r"\| [0M]", line)]
    return [[cell.strip(" `") for cell in line] for line in lines]


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


def require_proof(proof: str) -> None:
    """A proof is CHAPTER#cell or exercise#cell, exercise: check, test_file::test, or exercise/kind/submission."""
    if "#" in proof:
        notebook, cell = proof.split("#")
        assert cell in cell_ids(notebook), proof
    elif "::" in proof:
        file, test = proof.split("::")
        (path,) = ROOT.glob(f"tests/robot/*/{file}.py")
        assert f"def {test}(" in path.read_text(), proof
    elif ": " in proof:
        exercise, check = proof.split(": ")
        assert check in check_ids(exercise), proof
    else:
        known_submission(*proof.split("/", 1))


def test_no_row_that_was_done_has_gone() -> None:
    assert [row[0] for row in rows()] == DONE


@pytest.mark.parametrize("row", rows(), ids=lambda row: row[0])
def test_a_row_has_its_proofs(row: list[str]) -> None:
    proofs = [proof for proof in row[2:] if proof]
    assert len(proofs) >= 2
    for proof in proofs:
        require_proof(proof)


def test_a_misconception_is_named_by_its_submission() -> None:
    for name, _, _, submission in (row for row in rows() if row[0].startswith("M")):
        assert f"({name})" in known_submission(*submission.split("/", 1)).about


@pytest.mark.parametrize(
    "proof", ["02_services#no-such-cell", "battery_service: no_such_check", "a/faulty/none"]
)
def test_a_proof_that_is_gone_is_noticed(proof: str) -> None:
    with pytest.raises((AssertionError, HeaderError)):
        require_proof(proof)
