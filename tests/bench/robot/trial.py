"""A trial: many independent runs of the robot, summarized in rows of one table."""

from __future__ import annotations

import math
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from robot_sim.humanoid import Humanoid
from robot_sim.model.side import SIDES
from robot_sim.state import Mode


@dataclass(frozen=True)
class Run:
    """The outcome of one run.

    Attributes:
        case: what was tried, printable.
        success: it did what it should.
        note: why not, or "".
        values: measured numbers by name, with the unit in the name.
    """

    case: Any
    success: bool
    note: str
    values: dict[str, float]


@dataclass(frozen=True)
class Summary:
    """One row of the table.

    Attributes:
        title: what was tried.
        successes, runs: how often it worked.
        measured: the figures, in words.
        reference: the figures it is held to, in words.
        met: the reference is reached.
        real_time_factor: simulated per processor second; NaN where it means nothing.
        failures: one line for each run that failed.
    """

    title: str
    successes: int
    runs: int
    measured: str
    reference: str
    met: bool
    real_time_factor: float = math.nan
    failures: tuple[str, ...] = ()


# the robot afterwards, what is wrong or "", measured numbers
Attempt = tuple[Humanoid, str, dict[str, float]]


class Trial(ABC):
    """Its cases, how to try one (in any process), and how to sum up."""

    @abstractmethod
    def cases(self, quick: bool) -> Sequence[Any]:
        """Return the arguments of the runs; `quick`: a few only."""

    @abstractmethod
    def attempt(self, case: Any) -> Attempt:
        """Try one case."""

    @abstractmethod
    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return rows from the runs, in the order of the cases."""

    def run(self, case: Any) -> Run:
        """Try one case; a fall is noted before anything else, and what the attempt has not measured is added."""
        clock = Clock()
        humanoid, note, values = self.attempt(case)
        if has_fallen(humanoid) and not note.startswith("fell"):
            note = "fell"
        measured = {"duration_s": humanoid.time, "simulated_s": humanoid.time, "cpu_s": clock.read()}
        return Run(_printable(case), not note, note, measured | values)


def _printable(case: Any) -> Any:
    if isinstance(case, tuple):
        return tuple(map(_printable, case))
    return round(case, 3) if isinstance(case, float) else case


class Clock:
    """Processor time of a run, from its making."""

    def __init__(self) -> None:
        self._start = time.process_time()

    def read(self) -> float:
        """Return the processor seconds since it was made."""
        return time.process_time() - self._start


def simulate(humanoid: Humanoid, seconds: float, until: Callable[[], bool] | None = None) -> bool:
    """Step for `seconds` of simulated time, or `until` something is true (asked every 20 ms).

    Returns:
        Whether `until` became true; a fall ends the simulation as well.
    """
    every = max(1, round(0.02 / humanoid.timestep))
    for tick in range(1, round(seconds / humanoid.timestep) + 1):
        humanoid.step()
        if tick % every == 0:
            if until is not None and until():
                return True
            if humanoid.mode is Mode.FALLEN:
                return False
    return False


def has_fallen(humanoid: Humanoid) -> bool:
    """Return whether the robot lies on the floor."""
    return humanoid.mode is Mode.FALLEN


def base_speed(humanoid: Humanoid) -> float:
    """Return the speed of base_link in space, m/s."""
    x, y, z = humanoid.data.qvel[:3].tolist()
    return math.sqrt(x * x + y * y + z * z)


def feet_midpoint(humanoid: Humanoid) -> tuple[float, float]:
    """Return the point midway between the soles, which `walk_to` brings to its goal: (x, y) m, odom frame."""
    left, right = (humanoid.data.site(f"{side.letter}_sole").xpos.tolist() for side in SIDES)
    return (left[0] + right[0]) / 2, (left[1] + right[1]) / 2


def summary(
    title: str, runs: Sequence[Run], measured: str, reference: str, *, met: bool | None = None
) -> Summary:
    """Return the row of these runs, with their counts, real-time factor and failures.

    `met`: whether the reference is reached; None if every run has to succeed.
    """
    cpu = sum(run.values["cpu_s"] for run in runs)
    return Summary(
        title=title,
        successes=sum(run.success for run in runs),
        runs=len(runs),
        measured=measured,
        reference=reference,
        met=all(run.success for run in runs) if met is None else met,
        real_time_factor=sum(run.values["simulated_s"] for run in runs) / cpu if cpu else math.nan,
        failures=tuple(f"{run.case}: {run.note}" for run in runs if not run.success),
    )


def values_of(runs: Sequence[Run], name: str) -> list[float]:
    """Return one measured value of each successful run; [NaN] if there are none."""
    return [run.values[name] for run in runs if run.success] or [math.nan]


def mean(values: Sequence[float]) -> float:
    """Return the arithmetic mean."""
    return sum(values) / len(values)


def mean_and_max(metres: Sequence[float], digits: int = 0) -> str:
    """Return mean and maximum in words, in mm."""
    return f"mean {1000 * mean(metres):.{digits}f} mm, max {1000 * max(metres):.{digits}f} mm"
