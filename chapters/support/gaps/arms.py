"""Chapter 9: arms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from humanoid_interfaces.action import PickAndPlace
from lab.learning.gap import Gap, expect
from lab.learning.gap_check_helpers import read_program, run_student_code


def merges_two_plans() -> str:
    """Merge two plans at their start, halfway, and after their last point."""
    merged = read_program("merged.py")["merged"]
    left, right = {0.0: -0.5, 2.0: -1.5}, {0.5: -0.3, 1.5: -0.8, 3.0: -0.2}
    situations: tuple[tuple[float, dict[float, list[float]], str], ...] = (
        (
            0.0,
            {0.5: [-0.75, -0.3], 1.5: [-1.25, -0.8], 2.0: [-1.5, -0.6], 3.0: [-1.5, -0.2]},
            "each moment of either plan after `now` needs a point, and each point needs the positions of both joints: "
            "place_at(plan, moment)",
        ),
        (
            1.0,
            {0.5: [-1.25, -0.8], 1.0: [-1.5, -0.6], 2.0: [-1.5, -0.2]},
            "take the moments after `now`, and count their times from `now`: moment - now",
        ),
        (1.5, {0.5: [-1.5, -0.6], 1.5: [-1.5, -0.2]}, "leave out a moment that equals `now`: moment > now"),
        (3.5, {}, "both plans are over, so no point is left: return the empty dict"),
    )
    for now, wanted, reason in situations:
        got = run_student_code(partial(merged, dict(left), dict(right), now), "merged.py")
        expect(
            isinstance(got, dict),
            seen=f"merged(left, right, {now}) returned {got!r}",
            expected=repr(wanted),
            next="end with `return` and a dict",
        )
        expect(
            _is_close(got, wanted),
            seen=f"merged(left, right, {now}) returned {got!r}, for left {left} and right {right}",
            expected=repr(wanted),
            next=_advice_on_points(got, wanted, now) or reason,
        )
    return f"the right points at {len(situations)} moments, and no point of the past"


def _advice_on_points(got: Mapping[float, Any], wanted: Mapping[float, Any], now: float) -> str:
    """Return what to do about points that are wrong in another way than the situation's advice says; else ""."""
    if sorted(got) != list(got):
        return "the times of a trajectory must rise: take the moments in order with sorted()"
    has_its_times = len(got) == len(wanted) and np.allclose(list(got), list(wanted))
    if has_its_times and now > 0 and all(np.size(positions) == 2 for positions in got.values()):
        return (
            "the times are right; the positions are those of another moment. The plans have their own clock: "
            "place_at(plan, moment). Only the key counts from `now`"
        )
    return ""


def _is_close(got: Mapping[float, Sequence[float]], wanted: Mapping[float, Sequence[float]]) -> bool:
    """Whether both have nearly the same points, in the same order."""
    rows = [(at, *positions) for at, positions in got.items() if isinstance(positions, list | tuple)]
    due = [(at, *positions) for at, positions in wanted.items()]
    return list(map(len, rows)) == list(map(len, due)) and len(rows) == len(got) and np.allclose(rows, due)


def judges_by_both_tolerances() -> str:
    """Call judge() in several situations."""
    program = read_program("tolerances.py")
    go_on, off_path, there, missed = (program[name] for name in ("GO_ON", "OFF_PATH", "THERE", "MISSED"))
    situations = (
        (
            0.02,
            2.0,
            go_on,
            "a small error on the way means only that the joint follows: return THERE only when `left` is not above 0",
        ),
        (0.02, 0.1, go_on, "time is left, so the joint cannot have arrived yet: return GO_ON"),
        (0.4, 2.0, go_on, "0.4 rad is within PATH_TOLERANCE: GOAL_TOLERANCE counts only at the end"),
        (
            0.7,
            2.0,
            off_path,
            "an error over PATH_TOLERANCE ends the goal even while time is left: return OFF_PATH",
        ),
        (0.02, -0.1, there, "the time is over and the error is within GOAL_TOLERANCE: return THERE"),
        (
            0.02,
            -1.2,
            there,
            "a late arrival still counts: check GOAL_TOLERANCE before you return MISSED",
        ),
        (0.3, -0.2, go_on, "the joint has PATIENCE seconds more to arrive: return GO_ON until then"),
        (
            0.3,
            -1.2,
            missed,
            "PATIENCE is over and the error is over GOAL_TOLERANCE: return MISSED if left < -PATIENCE",
        ),
        (0.7, -0.2, off_path, "PATH_TOLERANCE also applies after the last point: check it first"),
    )
    for error, left, wanted, reason in situations:
        got = run_student_code(partial(program["judge"], error, left), "tolerances.py")
        expect(
            got == wanted,
            seen=f"judge({error}, {left}) returned {got!r}",
            expected=repr(wanted),
            next="end each path with `return` and a verdict" if got is None else reason,
        )
    return f"the right verdict in {len(situations)} situations"


def puts_the_cup_down() -> str:
    """Call end_canceled() with a hand that can put the cup down, and with one that cannot."""
    _cancel(stands=True)
    _cancel(stands=False)
    return "the hand opened only when the cup stood; both goals ended CANCELED after that"


def _cancel(*, stands: bool) -> None:
    """End a cancelled goal with the student's function; `stands` is whether the hand can put the cup down."""
    calls: list[str] = []
    hand, goal_handle, result = _Hand(calls, stands=stands), _GoalHandle(calls), PickAndPlace.Result()
    end_canceled = read_program("put_down.py")["end_canceled"]
    returned = run_student_code(partial(end_canceled, hand, goal_handle, result), "put_down.py")
    seen = f"the calls: {', then '.join(calls) or 'none'}"
    if "lower()" in calls:
        seen += f"; lower() returned {stands}"
    ends = [each for each in calls if each in _GoalHandle.TERMINAL_CALLS]
    expect(
        "lower()" in calls,
        seen=seen,
        expected="a call of lower()",
        next="call hand.lower() first: it puts the cup down where it stood",
    )
    expect(
        "open()" not in calls or calls.index("lower()") < calls.index("open()"),
        seen=seen,
        expected="lower(), then open()",
        next="lower the hand before you open it, or the cup falls",
    )
    if stands:
        expect(
            "open()" in calls,
            seen=seen,
            expected="a call of open(), because the cup stands",
            next="call hand.open() when hand.lower() has returned True",
        )
    else:
        expect(
            "open()" not in calls,
            seen=seen,
            expected="no call of open(), because the cup doesn't stand",
            next="open the hand only `if hand.lower():`",
        )
    expect(
        ends == ["canceled()"],
        seen=seen,
        expected="one call of canceled(), and no other terminal call",
        next="call goal_handle.canceled() after the hand has moved: without a terminal call rclpy aborts the goal"
        if not ends
        else "end the goal with one call of goal_handle.canceled() and with no other call, even if the hand keeps the "
        "cup: the client has cancelled it",
    )
    expect(
        calls[-1] == "canceled()",
        seen=seen,
        expected="canceled() as the last call",
        next="call goal_handle.canceled() after the hand has moved: CANCELED says that the robot is safe",
    )
    expect(
        returned is result,
        seen=f"end_canceled() returned {returned!r}",
        expected="it returns the result",
        next="end with `return result`",
    )


class _Hand:
    """A hand that holds a cup and records the calls of its methods."""

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
    """A goal handle that records its terminal calls."""

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
