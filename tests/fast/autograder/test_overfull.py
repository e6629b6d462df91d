"""A submission that exceeds the arena's memory faster than it can be ended fails; it is not "not graded"."""

from __future__ import annotations

import re
from contextlib import contextmanager

import pytest

from autograder.arena.events import NodeReady, NodeStarted
from autograder.authoring.checks import Scenario
from autograder.authoring.failure import Failure
from autograder.engine.arena_run import ArenaRun, NotGraded, run_in_arena
from autograder.engine.completeness import require_whole
from autograder.engine.exercise import Exercise, exercises_folder
from autograder.engine.submission_arena import LIMITS, ArenaEnded
from autograder.isolation.arena_process import ArenaReport, Ended, Kind
from autograder.isolation.captured_output import CapturedOutput
from ros_runtime.record.event import to_line

SCENARIO = Scenario("ask_once")
RUN = ArenaRun(
    Exercise("battery_service", exercises_folder() / "battery_service", ()),
    {"battery_service.py": b""},
    SCENARIO,
)
EVENTS = b"".join(map(to_line, (NodeStarted(t=10.0), NodeReady(t=12.0, waited=1.0)))) + b'{"kind": "cut of'


class _EndedArenas:
    """Arenas that end in a given way."""

    def __init__(self, ended: Ended) -> None:
        output = CapturedOutput(1)
        self.kind = Kind.NAMESPACES
        self._report = ArenaReport(ended, 137, 3.0, 3100.0, 2.0, True, output, output)

    @contextmanager
    def one(self):
        yield self

    def carry_out(self, spec, deadline, stop):
        raise ArenaEnded(self._report, EVENTS)


def test_it_is_graded_and_says_how_much_was_taken():
    record = run_in_arena(RUN, arenas=_EndedArenas(Ended.MEMORY))
    with pytest.raises(Failure) as failure:
        require_whole(record, SCENARIO)
    assert "at 2.0 s the whole arena held 3100 MiB; its limit is 1536 MiB" in failure.value.observed


@pytest.mark.parametrize(
    ("status", "said"),
    [
        (1, "ended with status 1"),
        (
            137,
            r"killed by signal 9 \(SIGKILL\), most often because .*memory ran out: grade again with --jobs 1",
        ),
        (139, r"killed by signal 11 \(SIGSEGV\)$"),
        (255, "ended with status 255"),
    ],
)
def test_an_end_by_a_signal_is_named_with_what_to_do(status, said):
    report = ArenaReport(Ended.EXIT, status, 3.0, 900.0, 2.0, True, CapturedOutput(1), CapturedOutput(1))
    assert re.search(said, report.explain(LIMITS))


@pytest.mark.parametrize("ended", [Ended.DEADLINE, Ended.EXIT, Ended.KILLED])
def test_any_other_end_is_not_the_students_failure(ended):
    with pytest.raises(NotGraded):
        run_in_arena(RUN, arenas=_EndedArenas(ended))
