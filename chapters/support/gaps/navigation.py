"""Chapter 8: navigation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import pairwise
from typing import Any

from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import read_program, run_student_code

ODOM_RATE = 20  # Hz
SPEED = 0.35  # m/s, of the robot
SWAY, SWAY_PERIOD = 0.03, 0.88  # m to each side, s for two steps
MAX_PATH_ERROR_RATIO = 0.15  # of the distance really walked
MAX_COUNTED_SWAY = 0.25  # m, for a robot that steps on the spot
MARCH_DURATION = 30.0  # s
LONG_PIECES = "a piece of 0.5 m and one of 0.9 m"
SHORT_PIECE = 0.01  # m, less than the distance between most points of the march


def decides_the_phase() -> str:
    """Call next_phase() in several situations."""
    program = read_program("route.py")
    turn, walk, there = (program[name] for name in ("TURN", "WALK", "THERE"))
    situations = (
        (walk, 1.5, 0.0, walk, "the distance is over REACH: return WALK"),
        (walk, 1.5, 0.3, walk, "in phase WALK a bearing below ASTRAY is allowed: return WALK"),
        (walk, 1.5, 0.8, turn, "a bearing over ASTRAY ends the phase WALK: return TURN"),
        (walk, 1.5, -0.8, turn, "a bearing to the right is negative: compare abs(bearing)"),
        (turn, 1.5, -0.3, turn, "in phase TURN the bearing must get below ALIGNED: return TURN until then"),
        (turn, 1.5, 0.1, walk, "the bearing is below ALIGNED: return WALK"),
        (
            turn,
            0.5,
            1.2,
            turn,
            "near the point the robot must also face it: check the bearing before the distance",
        ),
        (
            turn,
            0.5,
            0.05,
            there,
            "the distance is below REACH and the bearing is below ALIGNED: return THERE",
        ),
        (
            walk,
            0.55,
            0.3,
            there,
            "in phase WALK a bearing below ASTRAY is allowed, and the robot is near: return THERE",
        ),
        (there, 0.7, 0.05, walk, "the robot was pushed away and the distance is over REACH: return WALK"),
        (there, 0.5, 0.3, turn, "ASTRAY is the limit in phase WALK only: in phase THERE it is ALIGNED, too"),
    )
    for phase, distance, bearing, wanted, reason in situations:
        got = run_student_code(partial(program["next_phase"], phase, distance, bearing), "route.py")
        expect(
            got == wanted,
            seen=f"next_phase({phase!r}, {distance}, {bearing}) returned {got!r}",
            expected=repr(wanted),
            next="end each path with `return` and a phase" if got is None else reason,
        )
    return f"the right phase in {len(situations)} situations, one of them after a push"


def leaves_out_the_sway() -> str:
    """Compute the length of four paths that contain the sway of the pelvis, and compare it with the true length."""
    walked = read_program("odometer.py")["walked"]
    paths = {
        "2 m straight": (2.0, _along([(0, 0), (2, 0)])),
        "2 m there and 2 m back": (4.0, _along([(0, 0), (2, 0), (0, 0)])),
        "1.5 m ahead and 1.5 m to the left": (3.0, _along([(0, 0), (1.5, 0), (1.5, 1.5)])),
        LONG_PIECES: (1.4, [(0.0, 0.0), (0.5, 0.0), (1.4, 0.0)]),
    }
    march = list(_march())
    marched = _walked(walked, march)
    found = {name: _walked(walked, points) for name, (_, points) in paths.items()}
    naive = _walked_naively(march)
    expect(
        marched < naive / 2,
        seen=f"walked() returned {marched:.2f} m for a robot that steps on the spot for {MARCH_DURATION:g} s; "
        f"the sum of all pieces is {naive:.2f} m",
        expected=f"less than {MAX_COUNTED_SWAY} m",
        next="skip a piece that is shorter than `shortest`, and set last = here only when you count a piece",
    )
    for name, (truth, _) in paths.items():
        metres = found[name]
        if abs(metres - truth) <= MAX_PATH_ERROR_RATIO * truth:
            continue
        if "back" in name and metres < 0.5:
            advice = "add up the pieces: the distance from the start is small again after the way back"
        elif name == LONG_PIECES:
            advice = "add the piece itself, the distance from last to here, not `shortest`"
        elif metres < truth:
            advice = "add each piece that is long enough to metres with +=, and then set last = here"
        else:
            advice = "set last = here when you count a piece, or the same metres are counted again"
        raise not_yet(
            f"walked() returned {metres:.2f} m for {name}",
            f"{truth:.2f} m, within {MAX_PATH_ERROR_RATIO:.0%}",
            advice,
        )
    expect(
        marched <= MAX_COUNTED_SWAY,
        seen=f"walked() returned {marched:.2f} m for a robot that steps on the spot for {MARCH_DURATION:g} s",
        expected=f"at most {MAX_COUNTED_SWAY} m",
        next="compare each piece with `shortest`: a shorter one may be sway",
    )
    everything = float(run_student_code(partial(walked, march, SHORT_PIECE), "odometer.py"))
    expect(
        everything > naive / 2,
        seen=f"walked() returned {everything:.2f} m for a robot that steps on the spot, with shortest={SHORT_PIECE}",
        expected=f"almost {naive:.2f} m, the sum of all pieces",
        next="compare with the argument `shortest`, not with a number of your own",
    )
    return (
        f"{', '.join(f'{metres:.2f} m for {name}' for name, metres in found.items())}; "
        f"{marched:.2f} m for stepping on the spot"
    )


def ignores_invalid_percentages() -> str:
    """Call decide() with valid and invalid percentages."""
    program = read_program("battery_watch.py")
    ignore, cancel, go_on = (program[name] for name in ("IGNORE", "CANCEL", "GO_ON"))
    percentages = (
        (0.8, go_on, "the charge is above LIMIT: return GO_ON"),
        (0.21, go_on, "the charge is just above LIMIT: do not round"),
        (0.19, cancel, "the charge is below LIMIT: return CANCEL"),
        (0.199999, cancel, "do not round: the robot would walk on below LIMIT"),
        (0.20000000298, go_on, "this is 0.20 as a float32: use < and do not round"),
        (0.0, cancel, "0.0 is a valid charge, an empty battery: allow it with 0.0 <= percentage"),
        (1.0, go_on, "1.0 is a valid charge, a full battery: allow it with percentage <= 1.0"),
        (math.nan, ignore, "every `<` and `>` with NaN is false: test `not 0.0 <= percentage <= 1.0`"),
        (17.0, ignore, "17.0 comes from a driver that counts to 100: test `not 0.0 <= percentage <= 1.0`"),
        (
            -0.05,
            ignore,
            "a charge below 0 does not exist: check the range before you compare with LIMIT",
        ),
    )
    for percentage, wanted, reason in percentages:
        got = run_student_code(partial(program["decide"], percentage), "battery_watch.py")
        expect(
            got == wanted,
            seen=f"decide({percentage:g}) returned {got!r}",
            expected=repr(wanted),
            next="end each path with `return` and IGNORE, CANCEL or GO_ON" if got is None else reason,
        )
    return f"the right decision for {len(percentages)} percentages, three of them invalid"


def _walked(walked: Callable[..., Any], points: Iterable[tuple[float, float]]) -> float:
    return float(run_student_code(partial(walked, list(points)), "odometer.py"))


def _walked_naively(points: Iterable[tuple[float, float]]) -> float:
    places = list(points)
    return sum(math.dist(one, other) for one, other in pairwise(places))


def _along(corners: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the path through the corners as odom would publish it, with the sway to both sides."""
    points: list[tuple[float, float]] = []
    for (x, y), (then_x, then_y) in pairwise(corners):
        length = math.dist((x, y), (then_x, then_y))
        ahead = (then_x - x) / length, (then_y - y) / length
        count = round(length / SPEED * ODOM_RATE)
        for index in range(count + 1):
            done, aside = index / count * length, _sway(len(points) / ODOM_RATE)
            points.append((x + done * ahead[0] - aside * ahead[1], y + done * ahead[1] + aside * ahead[0]))
    return points


def _march() -> Iterator[tuple[float, float]]:
    """Return the path of a robot that steps on the spot."""
    return ((0.01 * math.cos(2 * math.pi * t / SWAY_PERIOD), _sway(t)) for t in _times(MARCH_DURATION))


def _times(seconds: float) -> list[float]:
    return [index / ODOM_RATE for index in range(round(seconds * ODOM_RATE))]


def _sway(t: float) -> float:
    return SWAY * math.sin(2 * math.pi * t / SWAY_PERIOD)


GAPS = (
    Gap("route.py", decides_the_phase),
    Gap("odometer.py", leaves_out_the_sway),
    Gap("battery_watch.py", ignores_invalid_percentages),
)
