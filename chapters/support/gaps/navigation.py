"""Chapter 8: navigation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import pairwise
from typing import Any

from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import read_program, run_student_code

RATE = 20  # Hz, of odom
SPEED = 0.35  # m/s, of the robot
SWAY, SWAY_PERIOD = 0.03, 0.88  # m to each side, s for two steps
MAX_PATH_ERROR_RATIO = 0.15  # of the distance really walked
MAX_COUNTED_SWAY = 0.25  # m that an odometer may count for a robot that marches on the spot
MARCH_DURATION = 30.0  # s
SHORT_PIECE = 0.01  # m, shorter than most pieces of the march


def decides_the_phase() -> str:
    """Ask for the next phase in one situation after the other."""
    program = read_program("route.py")
    turn, walk, there = (program[name] for name in ("TURN", "WALK", "THERE"))
    situations = (
        (walk, 1.5, 0.0, walk, "the distance is over REACH: go on walking"),
        (walk, 1.5, 0.3, walk, "the robot walks and the bearing is below ASTRAY: it steers while it walks"),
        (walk, 1.5, 0.8, turn, "a bearing over ASTRAY ends the walking"),
        (walk, 1.5, -0.8, turn, "a bearing to the right is negative: compare abs(bearing)"),
        (turn, 1.5, -0.3, turn, "a robot that turns goes on until the bearing is below ALIGNED"),
        (turn, 1.5, 0.1, walk, "the bearing is below ALIGNED: walk"),
        (
            turn,
            0.5,
            1.2,
            turn,
            "near is not enough: the robot has to look at the point, so ask for the bearing first",
        ),
        (turn, 0.5, 0.05, there, "the distance is below REACH and the robot looks at the point"),
        (walk, 0.55, 0.3, there, "it walked, and the bearing is below ASTRAY: it is there"),
        (there, 0.7, 0.05, walk, "a push took the robot away: the distance is over REACH"),
    )
    for phase, distance, bearing, wanted, reason in situations:
        got = run_student_code(partial(program["next_phase"], phase, distance, bearing), "route.py")
        expect(
            got == wanted,
            seen=f"{got!r} for phase {phase!r}, {distance} m and a bearing of {bearing} rad",
            expected=repr(wanted),
            next="end each path with `return` and a phase" if got is None else reason,
        )
    return f"the right phase in {len(situations)} situations, one of them after a push"


def forgets_the_sway() -> str:
    """Walk four paths, each with the sway of the pelvis, and compare the distances."""
    walked = read_program("odometer.py")["walked"]
    paths = {
        "2 m straight": (2.0, _along([(0, 0), (2, 0)])),
        "2 m there and 2 m back": (4.0, _along([(0, 0), (2, 0), (0, 0)])),
        "1.5 m ahead and 1.5 m to the left": (3.0, _along([(0, 0), (1.5, 0), (1.5, 1.5)])),
    }
    march = list(_march())
    marched = _walked(walked, march)
    found = {name: _walked(walked, points) for name, (_, points) in paths.items()}
    naive = _walked_naively(march)
    expect(
        marched < naive / 2,
        seen=f"{marched:.2f} m for a robot that marches {MARCH_DURATION:g} s on the spot; all pieces are {naive:.2f} m",
        expected=f"less than {MAX_COUNTED_SWAY} m",
        next="do nothing as long as the piece from last to here is shorter than `shortest`; move last only when a "
        "piece counts",
    )
    for name, (truth, _) in paths.items():
        metres = found[name]
        if abs(metres - truth) <= MAX_PATH_ERROR_RATIO * truth:
            continue
        if "back" in name and metres < 0.5:
            advice = "add up pieces; the distance from the start forgets the way back"
        elif metres < truth:
            advice = "add each piece that is long enough to metres with +=, and set last = here then"
        else:
            advice = "set last = here when a piece counts, or the same metres count again"
        raise not_yet(
            f"{metres:.2f} m for {name}", f"{truth:.2f} m, within {MAX_PATH_ERROR_RATIO:.0%}", advice
        )
    expect(
        marched <= MAX_COUNTED_SWAY,
        seen=f"{marched:.2f} m for a robot that marches {MARCH_DURATION:g} s on the spot",
        expected=f"at most {MAX_COUNTED_SWAY} m",
        next="compare with `shortest`: a shorter piece may be sway",
    )
    everything = float(run_student_code(partial(walked, march, SHORT_PIECE), "odometer.py"))
    expect(
        everything > naive / 2,
        seen=f"{everything:.2f} m for the march with shortest={SHORT_PIECE}",
        expected=f"almost {naive:.2f} m, the sum of all pieces",
        next="compare with the argument `shortest`, not with a number of your own",
    )
    return f"{', '.join(f'{metres:.2f} m for {name}' for name, metres in found.items())}; {marched:.2f} m for marching"


def knows_a_charge() -> str:
    """Hand in one percentage after the other."""
    program = read_program("battery_watch.py")
    ignore, cancel, go_on = (program[name] for name in ("IGNORE", "CANCEL", "GO_ON"))
    percentages = (
        (0.8, go_on, "a charge above LIMIT: go on"),
        (0.21, go_on, "a charge just above LIMIT: do not round"),
        (0.19, cancel, "a charge below LIMIT: cancel"),
        (0.199999, cancel, "do not round: the robot would walk on below LIMIT"),
        (0.20000000298, go_on, "0.20 as it arrives: use < and do not round"),
        (0.0, cancel, "0.0 is a charge, an empty battery: let it through with 0.0 <= percentage"),
        (1.0, go_on, "1.0 is a charge, a full battery: let it through with percentage <= 1.0"),
        (math.nan, ignore, "every `<` and `>` with NaN is false: ask `not 0.0 <= percentage <= 1.0`"),
        (17.0, ignore, "17.0 is of a driver that counts to 100: ask `not 0.0 <= percentage <= 1.0`"),
        (
            -0.05,
            ignore,
            "a charge below 0 does not exist: ask whether it is one before you compare with LIMIT",
        ),
    )
    for percentage, wanted, reason in percentages:
        got = run_student_code(partial(program["decide"], percentage), "battery_watch.py")
        expect(
            got == wanted,
            seen=f"{got!r} for {percentage:g}",
            expected=repr(wanted),
            next="end each path with `return` and IGNORE, CANCEL or GO_ON" if got is None else reason,
        )
    return f"the right answer for {len(percentages)} percentages, three of them no charge"


def _walked(walked: Callable[..., Any], points: Iterable[tuple[float, float]]) -> float:
    return float(run_student_code(partial(walked, list(points)), "odometer.py"))


def _walked_naively(points: Iterable[tuple[float, float]]) -> float:
    places = list(points)
    return sum(math.dist(one, other) for one, other in pairwise(places))


def _along(corners: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The path through the corners as odom tells it, 20 times a second, with the sway across."""
    points: list[tuple[float, float]] = []
    for (x, y), (then_x, then_y) in pairwise(corners):
        length = math.dist((x, y), (then_x, then_y))
        ahead = (then_x - x) / length, (then_y - y) / length
        count = round(length / SPEED * RATE)
        for index in range(count + 1):
            done, aside = index / count * length, _sway(len(points) / RATE)
            points.append((x + done * ahead[0] - aside * ahead[1], y + done * ahead[1] + aside * ahead[0]))
    return points


def _march() -> Iterator[tuple[float, float]]:
    """A robot that steps on the spot."""
    return ((0.01 * math.cos(2 * math.pi * t / SWAY_PERIOD), _sway(t)) for t in _times(MARCH_DURATION))


def _times(seconds: float) -> list[float]:
    return [index / RATE for index in range(round(seconds * RATE))]


def _sway(t: float) -> float:
    return SWAY * math.sin(2 * math.pi * t / SWAY_PERIOD)


GAPS = (
    Gap("route.py", decides_the_phase),
    Gap("odometer.py", forgets_the_sway),
    Gap("battery_watch.py", knows_a_charge),
)
