"""Crouching and standing up in phases, each of which ends when measurements confirm it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from robot_sim.walking.body_height import BodyHeight, HeightLimits
from robot_sim.walking.planar import clamp
from robot_sim.walking.walker import Walker

PEAK_OVER_MEAN = 15 / 8  # speed of a minimum-jerk motion


@dataclass(frozen=True, slots=True)
class HeightChangeParameters:
    """Conditions that end the phases of crouching and standing up."""

    balanced: float = 0.02  # m, DCM from the middle of the feet, up to which the motion may start
    least_load_share: float = 0.4  # share of the load that each foot must bear before the motion starts
    thrown: float = 0.05  # m, DCM from the middle of the feet, above which the weight has to be shifted again
    near: float = 0.01  # m from the target height, at which settling begins
    settled: float = 0.005  # m from the target height, at which settling may end
    upright: float = 0.998  # z component of the pelvis' up-vector
    still: float = 0.02  # m/s
    hold: float = 0.2  # s for which a condition has to hold
    time_limit: float = 12.0  # s, for all phases; the longest motion takes 2 s


class HeightPhase(Enum):
    """The phase of a change of height; students can publish the values as feedback."""

    SHIFTING = "shifting"  # the weight comes to rest over the middle of both feet
    LOWERING = "lowering"
    RISING = "rising"
    SETTLING = "settling"  # the last centimetre, until height, attitude and speed are within bounds
    DONE = "done"
    FAILED = "failed"

    @property
    def is_last(self) -> bool:
        """Whether no phase follows."""
        return self in (HeightPhase.DONE, HeightPhase.FAILED)


class HeightChange:
    """A motion of the pelvis to a height along a minimum-jerk profile.

    T. Flash, N. Hogan, "The coordination of arm movements", Journal of Neuroscience 5(7), 1985. If a push moves the
    weight away from the middle of the feet, or makes the robot step, the phase returns to shifting and the motion
    continues from there.

    Args:
        walker: whose state is measured.
        target: height (m) of the pelvis above the floor.
        speed: maximum of the profile, m/s.

    Attributes:
        phase: the present one.
        problem: why the change failed, else "".
        height: the commanded height of the pelvis now, m.
    """

    def __init__(self, walker: Walker, target: float, speed: float) -> None:
        self.phase = HeightPhase.SHIFTING
        self.problem = ""
        self.height = walker.height
        self._walker, self._sensed = walker, walker.sensed
        self._target = target
        self._speed = speed
        self._parameters = HeightChangeParameters()
        self._first_height = self._measured_height()
        self._start, self._progress, self._duration = self.height, 0.0, 0.0
        self._time = self._fulfilled = 0.0

    @property
    def percent_complete(self) -> float:
        """Measured share of the pelvis' way, 0 to 100; 100 only in the phase DONE."""
        if self.phase is HeightPhase.DONE:
            return 100.0
        way = self._target - self._first_height
        if abs(way) < self._parameters.near:
            return 0.0
        return clamp(100 * (self._measured_height() - self._first_height) / way, 0.0, 99.0)

    def fail(self, problem: str) -> None:
        """End an unfinished change for an outside reason, such as a fall."""
        if not self.phase.is_last:
            self.problem = f"{problem} while {self.phase.value}"
            self.phase = HeightPhase.FAILED

    def tick(self, dt: float) -> None:
        """Update phase and `height` for the next `dt` (s) by the measured state; do not call it after the end."""
        self._time += dt
        if self._time > self._parameters.time_limit:
            self.fail(f"not done within {self._parameters.time_limit:g} s ({self._state()})")
        elif self.phase is HeightPhase.SHIFTING:
            if self._lasts(self._is_balanced(), dt):
                self._set_out()
        elif self._is_thrown():
            self._enter(HeightPhase.SHIFTING)
        else:
            self._follow_profile(dt)

    def _set_out(self) -> None:
        """Begin a profile from the present height."""
        self._start, self._progress = self.height, 0.0
        way = self._target - self._start
        self._duration = PEAK_OVER_MEAN * abs(way) / self._speed
        if way == 0:
            self._enter(HeightPhase.SETTLING)
        else:
            self._enter(HeightPhase.RISING if way > 0 else HeightPhase.LOWERING)

    def _follow_profile(self, dt: float) -> None:
        self._progress = min(1.0, self._progress + dt / self._duration) if self._duration else 1.0
        s = self._progress
        self.height = self._start + (self._target - self._start) * s * s * s * (10 + s * (6 * s - 15))
        if self.phase is not HeightPhase.SETTLING:
            if abs(self._error()) < self._parameters.near:
                self._enter(HeightPhase.SETTLING)
        elif self._lasts(self._is_settled(), dt):
            self._enter(HeightPhase.DONE)

    def _enter(self, phase: HeightPhase) -> None:
        self.phase, self._fulfilled = phase, 0.0

    def _lasts(self, condition: bool, dt: float) -> bool:
        """Return whether a condition has been true for long enough without a break."""
        self._fulfilled = self._fulfilled + dt if condition else 0.0
        return self._fulfilled >= self._parameters.hold

    # What is measured

    def _measured_height(self) -> float:
        return self._sensed.pelvis[2] - self._sensed.ground

    def _error(self) -> float:
        """Return the distance to the target height, m."""
        return self._target - self._measured_height()

    def _offset(self) -> float:
        """Return how far the DCM is from the middle of the feet, m."""
        x, y, _ = self._sensed.feet_centre
        return math.hypot(self._sensed.dcm[0] - x, self._sensed.dcm[1] - y)

    def _base_speed(self) -> float:
        return math.hypot(*self._sensed.base_velocity[:3])

    def _is_balanced(self) -> bool:
        """Return whether both feet stand with about the same load and the DCM is near their middle."""
        loads = self._sensed.foot_loads
        even = min(loads) >= self._parameters.least_load_share * sum(loads) > 0
        return self._walker.stands and even and self._offset() < self._parameters.balanced

    def _is_thrown(self) -> bool:
        return not self._walker.stands or self._offset() > self._parameters.thrown

    def _is_settled(self) -> bool:
        bounds = self._parameters
        return (
            abs(self._error()) < bounds.settled
            and self._sensed.pelvis_rotation[8] > bounds.upright
            and self._base_speed() < bounds.still
        )

    def _state(self) -> str:
        """Return the measured state, for a message."""
        return (
            f"{'both feet stand' if self._walker.stands else 'the feet step'}, the weight is "
            f"{1000 * self._offset():.0f} mm off their middle, the pelvis {1000 * abs(self._error()):.0f} mm from its "
            f"height, at {self._base_speed():.2f} m/s"
        )


class PhasedHeight(BodyHeight):
    """The controller of the pelvis' height, which can also change the height in phases.

    Attributes:
        change: the last change of height in phases, if any; while it lasts, `rate` is 0.
        before_tick: called with dt (s) before each tick, for example to update an estimate of the state.
    """

    _walker: Walker

    def __init__(self, walker: Walker, stance: float, limits: HeightLimits) -> None:
        super().__init__(walker, stance, limits)
        self.change: HeightChange | None = None
        self.before_tick: Callable[[float], object] = lambda dt: None

    @property
    def is_idle(self) -> bool:
        """Whether no motion is commanded, or the commanded motion has ended."""
        return super().is_idle and (self.change is None or self.change.phase.is_last)

    def move(self, rate: float) -> None:
        """Move up at `rate` (m/s; negative: down) until the next command; this ends a running change."""
        super().move(rate)
        self.interrupt("another command came")

    def change_to(self, height: float) -> HeightChange:
        """Move to a height (m), clamped to the limits, in phases.

        Raises:
            ValueError: the height is not finite.
        """
        if not math.isfinite(height):
            raise ValueError(f"the height is {height}; expected a finite number in m")
        self.move(0.0)
        self.change = HeightChange(self._walker, self._within_limits(height), self._limits.speed)
        return self.change

    def interrupt(self, problem: str) -> None:
        """End a running change as failed, with this reason; the height stays as it is."""
        if self.change is not None:
            self.change.fail(problem)

    def tick(self, dt: float) -> None:
        """Move the reference for the next `dt` (s)."""
        self.before_tick(dt)
        super().tick(dt)
        if self.change is not None and not self.change.phase.is_last:
            self.change.tick(dt)
            self.set(self.change.height)
