"""Chapter 9: arms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from humanoid_interfaces.action import PickAndPlace
from lab.learning.gap import Gap, expect
from lab.learning.gap_check_helpers import read_program, run_student_code


def merges_two_plans() -> str:
    """Merge plans at the start, on the way, and when nothing is left."""
    merged = read_program("merged.py")["merged"]
    left, right = {0.0: -0.5, 2.0: -1.5}, {0.5: -0.3, 1.5: -0.8, 3.0: -0.2}
    situations: tuple[tuple[float, dict[float, list[float]], str], ...] = (
        (
            0.0,
            {0.5: [-0.75, -0.3], 1.5: [-1.25, -0.8], 2.0: [-1.5, -0.6], 3.0: [-1.5, -0.2]},
            "each moment of either plan after `now` is a point, and each point has both joints: place_at(plan, moment)",
        ),
        (
            1.0,
            {0.5: [-1.25, -0.8], 1.0: [-1.5, -0.6], 2.0: [-1.5, -0.2]},
            "take the moments after `now`, and count their times from it: moment - now",
        ),
        (1.5, {0.5: [-1.5, -0.6], 1.5: [-1.5, -0.2]}, "a moment that is now is over: moment > now"),
        (3.5, {}, "nothing is still to come, so there is no point: return the empty dict"),
    )
    for now, wanted, reason in situations:
        got = run_student_code(partial(merged, dict(left), dict(right), now), "merged.py")
        expect(
            isinstance(got, dict),
            seen=f"{got!r} at {now} s",
            expected=repr(wanted),
            next="end with `return` and a dict",
        )
        expect(
            _is_close(got, wanted),
            seen=f"{got!r} at {now} s, for left {left} and right {right}",
            expected=repr(wanted),
            next="the times of a trajectory rise: take the moments in their order, sorted()"
            if sorted(got) != list(got)
            else reason,
        )
    return f"the right points at {len(situations)} moments, and none that is over"


def _is_close(got: Mapping[float, Sequence[float]], wanted: Mapping[float, Sequence[float]]) -> bool:
    """Whether both have the same points, in the same order."""
    rows = [(at, *positions) for at, positions in got.items() if isinstance(positions, list | tuple)]
    due = [(at, *positions) for at, positions in wanted.items()]
    return list(map(len, rows)) == list(map(len, due)) and len(rows) == len(got) and np.allclose(rows, due)


def judges_by_both_tolerances() -> str:
    """Ask for the verdict in one situation after the other."""
    program = read_program("tolerances.py")
    go_on, off_path, there, missed = (program[name] for name in ("GO_ON", "OFF_PATH", "THERE", "MISSED"))
    situations = (
        (
            0.02,
            2.0,
            go_on,
            "a small error on the way only says that the joint follows: ask whether `left` is over",
        ),
        (0.02, 0.1, go_on, "there is time left: the joint has not arrived before its last point is due"),
        (0.4, 2.0, go_on, "0.4 rad is within PATH_TOLERANCE: GOAL_TOLERANCE counts only at the end"),
        (0.7, 2.0, off_path, "an error over PATH_TOLERANCE ends the goal on the way, too"),
        (0.02, -0.1, there, "the time is over and the error is within GOAL_TOLERANCE"),
        (
            0.02,
            -1.2,
            there,
            "a late arrival counts until you have given up: ask for the arrival before MISSED",
        ),
        (0.3, -0.2, go_on, "the joint has PATIENCE seconds more to arrive"),
        (0.3, -1.2, missed, "PATIENCE is over and the error is not within GOAL_TOLERANCE: left < -PATIENCE"),
        (0.7, -0.2, off_path, "the path tolerance holds after the last point, too: ask for it first"),
    )
    for error, left, wanted, reason in situations:
        got = run_student_code(partial(program["judge"], error, left), "tolerances.py")
        expect(
            got == wanted,
            seen=f"{got!r} for an error of {error} rad with {left} s left",
            expected=repr(wanted),
            next="end each path with `return` and a verdict" if got is None else reason,
        )
    return f"the right verdict in {len(situations)} situations"


def puts_the_cup_down() -> str:
    """Cancel with a hand that can put the cup down, and with one that cannot."""
    _cancel(stands=True)
    _cancel(stands=False)
    return "the hand put the cup down, opened, and then the goal was CANCELED; where the cup hung, the hand kept it"


def _cancel(*, stands: bool) -> None:
    """End a cancelled goal by the student's function, with a hand whose cup then `stands`, or not."""
    calls: list[str] = []
    hand, goal_handle, result = _Hand(calls, stands=stands), _GoalHandle(calls), PickAndPlace.Result()
    end_canceled = read_program("put_down.py")["end_canceled"]
    returned = run_student_code(partial(end_canceled, hand, goal_handle, result), "put_down.py")
    seen = f"{', then '.join(calls) or 'nothing'}; lower() returned {stands}"
    ends = [each for each in calls if each in _GoalHandle.TERMINAL_CALLS]
    expect(
        "lower()" in calls,
        seen=seen,
        expected="a cup that is put down",
        next="call hand.lower() first: it brings the cup back to where it stood",
    )
    expect(
        "open()" not in calls or calls.index("lower()") < calls.index("open()"),
        seen=seen,
        expected="lower(), then open()",
        next="lower the hand before you open it: what it holds falls",
    )
    if stands:
        expect(
            "open()" in calls,
            seen=seen,
            expected="a hand that lets go of the cup, because it stands",
            next="call hand.open() when hand.lower() has returned True",
        )
    else:
        expect(
            "open()" not in calls,
            seen=seen,
            expected="a hand that stays closed: the cup doesn't stand",
            next="open only `if hand.lower():`",
        )
    expect(
        ends == ["canceled()"],
        seen=seen,
        expected="canceled(), once",
        next="call goal_handle.canceled() after the hand is done: without it rclpy aborts the goal"
        if not ends
        else "end the goal with goal_handle.canceled(), once, and with no other call, also where the hand keeps the "
        "cup: the client asked for a cancel",
    )
    expect(
        calls[-1] == "canceled()",
        seen=seen,
        expected="canceled() as the last of them",
        next="call goal_handle.canceled() when the hand is done: CANCELED says that the robot is safe",
    )
    expect(
        returned is result,
        seen=f"{returned!r} returned",
        expected="the result",
        next="end with `return result`",
    )


class _Hand:
    """A hand that holds a cup and writes down what it is told."""

    def __init__(self, calls: list[str], *, stands: bool) -> None:
        self.force = 7.0  # N
        self.cup = self.place = (0.35, -0.25, 0.855)  # m
        self._calls, self._stands = calls, stands

    def lower(self) -> bool:
        self._calls.append("lower()")
        self.cup = self.place = (0.35, -0.25, 0.755 if self._stands else 0.80)
        return self._stands

    def open(self) -> None:
        self._calls.append("open()")
        self.force = 0.0


class _GoalHandle:
    """A goal handle that writes down how the goal is ended."""

    TERMINAL_CALLS = ("canceled()", "succeed()", "abort()")
    is_cancel_requested = True

    def __init__(self, calls: list[str]) -> None:
        self._calls = calls

    def canceled(self) -> None:
        self._calls.append("canceled()")

    def succeed(self) -> None:
        self._calls.append("succeed()")

    def abort(self) -> None:
        self._calls.append("abort()")


GAPS = (
    Gap("merged.py", merges_two_plans),
    Gap("tolerances.py", judges_by_both_tolerances),
    Gap("put_down.py", puts_the_cup_down),
)
