"""The lines that a program prints about its callbacks, and the picture of its threads."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from lab.errors import LabError
from lab.pictures.thread_plot import NO_THREAD, Span, draw_threads, read_steps, spans_of


def node(log: str, ended: float | None = 20.0) -> Any:
    return SimpleNamespace(
        file=Path("scout.py"),
        log=lambda: log,
        history=lambda: SimpleNamespace(ended=ended),
        is_running=ended is None,
    )


def test_only_lines_about_callbacks_are_read_in_order_of_time() -> None:
    steps = read_steps("[INFO] hello\n10.2 MainThread beat ends\n10.1 MainThread beat begins\nbeat begins\n")
    assert [(step.time, step.verb) for step in steps] == [(10.1, "begins"), (10.2, "ends")]


def test_two_threads_run_the_same_callback_at_once() -> None:
    steps = read_steps("1.0 a look begins\n2.0 b look begins\n3.0 a look ends\n4.0 b look ends\n")
    assert spans_of(steps, 9.0) == [Span("a", "look", 1.0, 3.0), Span("b", "look", 2.0, 4.0)]


def test_a_coroutine_holds_no_thread_while_it_awaits_and_may_resume_on_another() -> None:
    steps = read_steps("1.0 a look begins\n2.0 a look awaits\n3.0 b look resumes\n4.0 b look ends\n")
    assert spans_of(steps, 9.0) == [
        Span("a", "look", 1.0, 2.0),
        Span(NO_THREAD, "look", 2.0, 3.0),
        Span("b", "look", 3.0, 4.0),
    ]


@pytest.mark.parametrize(("verb", "lane"), [("begins", "a"), ("awaits", NO_THREAD)])
def test_a_callback_that_never_ends_is_drawn_until_the_end(verb: str, lane: str) -> None:
    steps = read_steps(f"1.0 a look {verb}\n")
    assert spans_of(steps, 9.0) == [Span(lane, "look", 1.0, 9.0, is_over=False)]


def test_the_picture_has_a_text_alternative() -> None:
    beats = "".join(
        f"{10 + n}.0 MainThread beat begins\n{10 + n}.001 MainThread beat ends\n" for n in (0, 1, 5)
    )
    drawn = draw_threads(node(beats + "12.0 MainThread look begins\n"), title="One thread").data
    assert "<svg" in drawn or "<img" in drawn
    for told in (
        "One thread.",
        "MainThread: beat 3 times; look from 2.00 s on, without an end.",
        "from one beat to the next: 4.00 s",
    ):
        assert told in drawn


def test_for_a_program_without_such_a_line_the_error_says_what_to_do() -> None:
    with pytest.raises(LabError, match=r"scout\.py has printed no line like .* call trace\(\)"):
        draw_threads(node("hello\n"))
