"""The progress of a batch, on a terminal and elsewhere, and its estimate of the remaining time."""

from __future__ import annotations

import io

import pytest
from rich.console import Console

from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.job import Effort, GradingJob, Outcome
from autograder.classroom.batch.runner import Graded
from autograder.classroom.class_grading.progress import (
    MAX_LISTED_JOBS,
    PRINT_PERIOD,
    BatchProgress,
    Pace,
    in_words,
)
from autograder.engine.verdict import CheckVerdict, Grade

VERDICT = CheckVerdict("id", "title", "passed", 1, 1)


class Clock:
    """A clock that the test advances."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


def job(student: str) -> GradingJob:
    return GradingJob(student, "walk_to", {}, 0, True, "version")


def result(student: str, cached: bool = False) -> Graded:
    effort = Effort("", "", "here", 1.0, 1, 1)
    grade = Grade("walk_to", student, "namespaces", [VERDICT])
    return Graded(Work(student, "walk_to"), grade, {}, cached=cached, effort=effort)


@pytest.fixture
def clock() -> Clock:
    return Clock()


def test_remaining_time_follows_measured_durations_not_earlier_estimates(clock):
    pace = Pace(40, clock)
    assert pace.seconds_left() is None
    pace.add(20)
    pace.exclude_from_rate(20)
    clock.now = 10.0
    assert pace.seconds_left() is None
    pace.add(5)
    assert pace.seconds_left() == 30.0
    pace.add(15)
    assert pace.seconds_left() == 0.0


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (None, "time left not known yet"),
        (3, "about 10 s left"),
        (47, "about 50 s left"),
        (600, "about 10 min left"),
        (8000, "about 2.2 h left"),
    ],
)
def test_an_estimate_is_rounded_to_its_precision(seconds, words):
    assert in_words(seconds) == words


def test_without_a_terminal_progress_lines_are_printed_at_intervals(clock):
    console = Console(file=io.StringIO(), width=200)
    with BatchProgress(console, clock=clock) as progress:
        progress.expect(checks=3, submissions=3)
        progress.begin(job("anna"))
        progress.begin(job("bert"))
        progress.verdict(VERDICT)
        progress.graded(result("anna"), checks=1)
        progress.end(job("anna"))
        clock.now = PRINT_PERIOD
        progress.begin(job("carl"))
        progress.end(job("carl"))
    lines = console.file.getvalue().splitlines()
    assert lines[0].startswith("anna · walk_to")
    assert lines[1:] == [
        "… 1 of 3 submissions graded, about 1 min left; running: bert · walk_to, carl · walk_to"
    ]


def test_on_a_terminal_all_running_submissions_are_shown_with_their_time(clock):
    console = Console(file=io.StringIO(), width=200, force_terminal=True, color_system=None)
    with BatchProgress(console, clock=clock, elsewhere=4) as progress:
        progress.expect(checks=20, submissions=10)
        progress.begin(job("anna"))
        clock.now = 75.0
        for number in range(MAX_LISTED_JOBS):
            progress.begin(job(f"student{number}"))
        progress.graded(result("known", cached=True), checks=2)
    shown = console.file.getvalue()
    for words in (
        "anna · walk_to",
        "1:15",
        "and 1 more",
        "1 of 10 submissions",
        "not known yet",
        "4 workers",
    ):
        assert words in shown, words
    assert "known · walk_to" in shown


def test_a_submission_without_verdicts_is_counted_as_done(clock):
    console = Console(file=io.StringIO(), width=200)
    progress = BatchProgress(console, clock=clock)
    progress.expect(checks=4, submissions=2)
    clock.now = PRINT_PERIOD
    lost = Graded(Work("anna", "walk_to"), Grade("walk_to", "anna", "", reason="lost"), {})
    progress.graded(lost, checks=2)
    assert progress._pace.done == 2


def test_a_postponed_submission_is_reported_and_its_verdicts_are_expected_again(clock):
    console = Console(file=io.StringIO(), width=200)
    progress = BatchProgress(console, clock=clock)
    progress.expect(checks=1, submissions=1)
    progress.verdict(VERDICT)
    first = Grade("walk_to", "anna", "namespaces", [VERDICT], reason="the machine was too busy\nfor that")
    progress.retry_later(job("anna"), Outcome(first, retry_may_succeed=True))
    assert "anna · walk_to  not graded yet" in console.file.getvalue()
    assert console.file.getvalue().endswith("the machine was too busy\n")
    assert (progress._pace.done, progress._pace.expected) == (1, 2)
