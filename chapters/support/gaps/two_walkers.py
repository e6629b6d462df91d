"""Chapter 13: two walkers."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from lab.learning.gap import Gap, expect
from lab.learning.gap_check_helpers import read_program, run_student_code

FILE = "steer.py"
LIMITS = (0.4, 0.1, 0.4)  # the most that may be asked for: m/s, m/s, rad/s
WORDS = ("ahead", "to the left", "as a turn to the left")
STARTS = ((2.0, 0.0, 0.0), (1.0, 0.3, -0.5), (0.5, -0.4, 0.6))  # what is left: m, m, rad
PERIOD, TIME_LIMIT = 0.1, 40.0  # s
NEAR, NEAR_TURN = 0.06, 0.1  # m, rad
DRIFTS = {  # of a robot: part of the velocity that it walks, and what it adds (m/s, m/s, rad/s)
    "gives what is asked": (1.0, (0.0, 0.0, 0.0)),
    "walks 80 % of what is asked, drifts to the right and turns to the left": (0.8, (0.0, -0.015, 0.02)),
}


def brings_what_is_left_to_0() -> str:
    """Call steer() for single cases, then let it steer two simple robots to the goal."""
    steer = read_program(FILE)["steer"]
    for axis, word in enumerate(WORDS):
        for sign in (1.0, -1.0):
            _require_direction(steer, axis, sign, word)
    for name, (part, drift) in DRIFTS.items():
        for start in STARTS:
            _require_arrival(steer, name, part, drift, start)
    return f"{len(DRIFTS)} robots reached {len(STARTS)} goals each, one of them although it drifts"


def _velocities(steer: Any, left: tuple[float, ...]) -> tuple[float, float, float]:
    about = "ahead={:.2f}, aside={:.2f}, turn={:.2f}".format(*left)
    asked = run_student_code(partial(steer, *left), FILE)
    expect(
        isinstance(asked, tuple)
        and len(asked) == len(LIMITS)
        and all(isinstance(value, (int, float)) for value in asked),
        seen=f"steer({about}) returns {asked!r}",
        expected="three numbers: the velocities ahead, aside and turn",
        next="end with `return forwards, sideways, turning`",
    )
    for value, limit, word in zip(asked, LIMITS, WORDS, strict=True):
        expect(
            abs(value) <= limit,
            seen=f"steer({about}) asks for {value:.2f} {word}",
            expected=f"at most {limit} in both directions",
            next="limit each velocity with clamp(…)",
        )
    return asked


def _require_direction(steer: Any, axis: int, sign: float, word: str) -> None:
    """Require that what is left on one axis alone is made smaller, and nothing else is done."""
    left = [0.0, 0.0, 0.0]
    left[axis] = sign
    asked = _velocities(steer, tuple(left))
    expect(
        asked[axis] * sign > 0 and not any(value for index, value in enumerate(asked) if index != axis),
        seen=f"with {sign:+.0f} left {word} and nothing else, steer() asks for {asked}",
        expected=f"a velocity {word} with the same sign, and two zeros",
        next="make each velocity from the number of its direction; left is positive in both",
    )


def _require_arrival(
    steer: Any, name: str, part: float, drift: tuple[float, ...], start: tuple[float, ...]
) -> None:
    ahead, aside, turn = start
    for _ in range(round(TIME_LIMIT / PERIOD)):
        if math.hypot(ahead, aside) < NEAR and abs(turn) < NEAR_TURN:
            return
        asked = _velocities(steer, (ahead, aside, turn))
        vx, vy, wz = (part * value + added for value, added in zip(asked, drift, strict=True))
        turned = wz * PERIOD
        x, y = ahead - vx * PERIOD, aside - vy * PERIOD
        ahead = math.cos(turned) * x + math.sin(turned) * y
        aside = math.cos(turned) * y - math.sin(turned) * x
        turn -= turned
    expect(
        False,
        seen=f"a robot that {name} is still {math.hypot(ahead, aside):.2f} m and {abs(turn):.2f} rad from the goal "
        f"after {TIME_LIMIT:g} s",
        expected=f"less than {NEAR} m and {NEAR_TURN} rad",
        next="ask for about as many m/s as m are left, and as many rad/s as rad: more overshoots, less never arrives",
    )


GAPS = (Gap(FILE, brings_what_is_left_to_0),)
