"""A verdict has a readable length, whatever it quotes."""

from __future__ import annotations

from typing import Any

import pytest

from autograder.engine.verdict import LENGTH_NOTE, LONGEST, CheckVerdict, Grade
from autograder.report.table import explanation


def verdict(**texts: Any) -> CheckVerdict:
    return CheckVerdict("id", "Title", "failed", 0, 1, **texts)


@pytest.mark.parametrize("name", sorted(LONGEST))
def test_a_long_text_is_cut_and_ends_with_its_length(name: str) -> None:
    text = getattr(verdict(**{name: "x" * 1_234_567}), name)
    assert text == "x" * LONGEST[name] + "…[cut: 1,234,567 characters]"
    assert len(text) <= LONGEST[name] + LENGTH_NOTE


def test_an_ordinary_text_is_left_alone() -> None:
    assert verdict(observed="a gap of 1.3 s").observed == "a gap of 1.3 s"


def test_a_verdict_read_back_from_its_record_is_the_same() -> None:
    grade = Grade("any", "ada", "given", [verdict(observed="x" * 10_000)])
    assert Grade.from_json(grade.to_json()) == grade


@pytest.mark.parametrize(
    ("at", "shown"), [(30.0, ["  31.00 s  near"]), (15.0, ["   2.00 s  early", "  31.00 s  near"])]
)
def test_of_the_log_the_lines_about_the_failure_are_shown_or_the_last_ones(
    at: float, shown: list[str]
) -> None:
    table = explanation(verdict(log="   2.00 s  early\n  31.00 s  near", robot_time=at))
    assert [str(cell) for cell in table.columns[1].cells] == shown
