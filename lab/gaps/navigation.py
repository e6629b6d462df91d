"""Chapter 8: navigation."""

from __future__ import annotations

import math
import runpy
import traceback
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from lab.gap import Gap, expect, not_yet

RATE = 20  # Hz, of odom
SPEED = 0.35  # m/s, of the robot
SWAY, PERIOD = 0.03, 0.88  # m to each side, s for two steps
WITHIN = 0.15  # of the distance really walked
MOST_SWAY = 0.25  # m that an odometer may count for a robot that marches on the spot
MARCH = 30.0  # s
NEW_CHARGES = {"a charge above the limit": 0.8, "a charge just above the limit": 0.21}
NO_CHARGES = {"NaN": math.nan, "17.0, of a driver that counts to 100": 17.0, "a negative number": -0.05}


class Way(NamedTuple):
    """What is left to go: m, rad, rad."""

    distance: float
    bearing: float
    turn: float


def decides_the_phase() -> str:
    """Ask for the next phase in one situation after the other."""
    program = _program("route.py")
    first, walk, last, arrived = (program[name] for name in ("FIRST", "WALK", "LAST", "ARRIVED"))
    far = "is further than NEAR"
    situations = (
        (walk, Way(1.5, 0.0, 2.0), walk, f"the goal {far}: the turn to the goal's heading has time"),
        (walk, Way(1.5, 0.3, 0.0), walk, "the robot walks and the bearing is below ASTRAY: it steers while it walks"),
        (walk, Way(1.5, 0.8, 0.0), first, "a bearing over ASTRAY ends the walking"),
        (walk, Way(1.5, -0.8, 0.0), first, "a bearing to the right is negative: compare abs(way.bearing)"),
        (first, Way(1.5, -0.3, 0.0), first, "a robot that turns goes on until the bearing is below ALIGNED"),
        (first, Way(1.5, 0.1, 0.0), walk, "the bearing is below ALIGNED: walk"),
        (walk, Way(0.1, 2.5, 0.5), last, "the goal is near: the bearing says nothing any more"),
        (first, Way(0.02, 2.5, -0.5), last, "the turn is not below TURNED; a turn to the right is negative"),
        (last, Way(0.15, 0.1, 0.01), last, "the distance is not below CLOSE: arrived needs both"),
        (last, Way(0.03, -2.0, -0.03), arrived, "the distance is below CLOSE and the turn below TURNED"),
        (last, Way(0.6, 1.5, 0.0), first, f"a push took the robot away: the goal {far}, and the bearing is large"),
        (last, Way(0.6, 0.05, 0.0), walk, f"a push took the robot away: the goal {far}"),
    )  # fmt: skip
    for phase, way, wanted, reason in situations:
        got = _asked(partial(program["next_phase"], phase, way), "route.py")
        expect(
            got == wanted,
            seen=f"{got!r} for phase {phase!r} and {way}",
            expected=repr(wanted),
            next="end each path with `return` and a phase" if got is None else reason,
        )
    return f"the right phase in {len(situations)} situations, two of them after a push"


def forgets_the_sway() -> str:
    """Walk four paths, each with the sway of the pelvis, and compare the distances."""
    make = _program("odometer.py")["Odometer"]
    paths = {
        "2 m straight": (2.0, _along([(0, 0), (2, 0)])),
        "2 m there and 2 m back": (4.0, _along([(0, 0), (2, 0), (0, 0)])),
        "1.5 m ahead and 1.5 m to the left": (3.0, _along([(0, 0), (1.5, 0), (1.5, 1.5)])),
    }
    marched = _walked(make, _march())
    found = {name: _walked(make, points) for name, (_, points) in paths.items()}
    naive = _walked_naively(_march())
    expect(
        marched < naive / 2,
        seen=f"{marched:.2f} m for a robot that marches {MARCH:g} s on the spot; all pieces are {naive:.2f} m",
        expected=f"less than {MOST_SWAY} m",
        next="do nothing as long as the piece from self.last to self.here is shorter than LONG_ENOUGH; move self.last "
        "only when a piece counts",
    )
    for name, (truth, _) in paths.items():
        metres = found[name]
        if abs(metres - truth) <= WITHIN * truth:
            continue
        if "back" in name and metres < 0.5:
            advice = "add up pieces; the distance from the start forgets the way back"
        elif metres < truth:
            advice = "add each piece that is long enough to self.metres with +=, and set self.last = self.here then"
        else:
            advice = "set self.last = self.here when a piece counts, or the same metres count again"
        raise not_yet(f"{metres:.2f} m for {name}", f"{truth:.2f} m, within {WITHIN:.0%}", advice)
    expect(
        marched <= MOST_SWAY,
        seen=f"{marched:.2f} m for a robot that marches {MARCH:g} s on the spot",
        expected=f"at most {MOST_SWAY} m",
        next="compare with LONG_ENOUGH: a shorter piece may be sway",
    )
    return f"{', '.join(f'{metres:.2f} m for {name}' for name, metres in found.items())}; {marched:.2f} m for marching"


def sends_a_single_cancel() -> str:
    """Hand in one charge after the other."""
    make = _program("battery_watch.py")["BatteryWatch"]
    for name, charge in NEW_CHARGES.items():
        _decide(make, [charge], [False], f"{name} ({charge}): go on", "compare with `percentage < LIMIT`")
    for name, value in NO_CHARGES.items():
        _decide(
            make,
            [value],
            [False],
            f"{name} is no charge: ignore it",
            "ask whether 0.0 <= percentage <= 1.0 before you compare with LIMIT; with NaN that is false",
        )
    _decide(
        make,
        [0.2000000030],
        [False],
        "0.20 as it arrives: not below LIMIT",
        "use < and not <=, and do not round",
    )
    _decide(
        make,
        [0.5, 0.19],
        [False, True],
        "0.19 is below LIMIT",
        "return True for the first charge below LIMIT",
    )
    _decide(make, [0.0], [True], "0.0 is a charge: an empty battery", "let 0.0 through: 0.0 <= percentage")
    _decide(
        make,
        [0.19, 0.18, 0.17],
        [True, False, False],
        "True once",
        "set self.has_cancelled, and return False when it is set",
    )
    _decide(
        make,
        [math.nan, 0.3, 0.1],
        [False, False, True],
        "a NaN does not end the watch",
        "ignore the value only: the next message may be a charge again",
    )
    warnings = _decide(make, [math.nan, 17.0, math.nan], [False] * 3, "False for no charge", "return False")
    expect(
        len(warnings) == 1,
        seen=f"{len(warnings)} warnings for three values that are no charge",
        expected="one",
        next="call self.warn when self.has_warned is not set yet, and then set it",
    )
    quiet = _decide(make, [0.9, 0.19], [False, True], "True for 0.19", "return True")
    expect(
        not quiet,
        seen=f"a warning for sound charges: {quiet}",
        expected="none",
        next="warn of no charges only",
    )
    return "True once, with the first charge below 0.20; NaN and 17.0 ignored, with one warning"


def _decide(
    make: Callable[..., Any], values: list[float], wanted: list[bool], expected: str, advice: str
) -> list[str]:
    """Hand the values to a new watch, require these decisions, and return its warnings."""
    warnings: list[str] = []

    def decide() -> list[Any]:
        watch = make(warnings.append)
        return [watch.must_cancel(value) for value in values]

    got = _asked(decide, "battery_watch.py")
    if None in got:
        advice = "end each path with `return` and True or False"
    expect(
        None not in got and [bool(each) for each in got] == wanted,
        seen=f"{got} for {values}",
        expected=f"{wanted}: {expected}",
        next=advice,
    )
    return warnings


def _program(file: str) -> dict[str, Any]:
    """Run a student's file and return what it defines."""
    return _asked(lambda: runpy.run_path(file), file)


def _asked(call: Callable[[], Any], file: str) -> Any:
    """Call what the student wrote; an exception becomes an error that quotes its line."""
    try:
        return call()
    except Exception as problem:
        lines = [f for f in traceback.extract_tb(problem.__traceback__) if Path(f.filename).name == file]
        where = f" in line {lines[-1].lineno}: {lines[-1].line}" if lines else ""
        raise not_yet(
            f"{type(problem).__name__}: {problem}{where}", "no exception", "mend what this error names"
        ) from None


def _walked(make: Callable[[], Any], points: Iterable[tuple[float, float]]) -> float:
    def walk() -> float:
        odometer = make()
        for x, y in points:
            odometer.add(x, y)
        return float(odometer.walked())

    return float(_asked(walk, "odometer.py"))


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
    return ((0.01 * math.cos(2 * math.pi * t / PERIOD), _sway(t)) for t in _times(MARCH))


def _times(seconds: float) -> list[float]:
    return [index / RATE for index in range(round(seconds * RATE))]


def _sway(t: float) -> float:
    return SWAY * math.sin(2 * math.pi * t / PERIOD)


GAPS = (
    Gap("route.py", decides_the_phase),
    Gap("odometer.py", forgets_the_sway),
    Gap("battery_watch.py", sends_a_single_cancel),
)
