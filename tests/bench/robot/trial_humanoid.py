"""The humanoid of the trials, with controllers that the course's robot does without."""

from __future__ import annotations

from typing import Any

from bench.robot.height_change import HeightChange, HeightPhase, PhasedHeight
from bench.robot.reach import HandTarget, Reach, ReachingUpperBody
from bench.robot.state_estimate import StateEstimate
from robot_sim.humanoid import Humanoid
from robot_sim.humanoid_body import walker_of
from robot_sim.model.side import Side
from robot_sim.walking.body_height import HeightLimits
from robot_sim.walking.footsteps import Command


class TrialHumanoid(Humanoid):
    """A humanoid that also crouches and stands up in phases, reaches for points, and can estimate its own state.

    Args:
        scene: as of `Humanoid`, like `options`.
        estimates_state: the controller acts on a state estimated from its sensors instead of the simulator's.
    """

    _height: PhasedHeight
    _upper_body: ReachingUpperBody

    def __init__(self, scene: str = "flat", *, estimates_state: bool = False, **options: Any) -> None:
        self._estimates_state = estimates_state
        self._estimate: StateEstimate | None = None
        super().__init__(scene, **options)

    def crouch_to(self, height: float) -> HeightChange:
        """Move the pelvis to `height` (m, 0.45 to 0.60 above the floor) in phases, which end by measurements.

        The returned object has the phase, the progress, and the reason of a failure: a fall, motors off, another
        command to walk or to move the body, or a timeout.

        Raises:
            ValueError: the height is not finite.
        """
        change = self._height.change_to(height)
        self._rest.wake()
        if not self.motors_enabled:
            change.fail("the motors are off")
        return change

    def stand_up(self) -> HeightChange:
        """Rise from any crouch to the stance; otherwise like `crouch_to`."""
        return self.crouch_to(self.stance_height)

    @property
    def body_phase(self) -> HeightPhase | None:
        """The phase of the last `crouch_to` or `stand_up` since reset; None without one."""
        return self._height.change.phase if self._height.change else None

    def reach(self, side: Side, target: HandTarget) -> Reach:
        """Move the hand of a side to a target in the odom frame; `error()` of the result is the distance to it.

        Raises:
            ValueError: the target is not finite.
        """
        self._rest.wake()
        return self._upper_body.reach(side, target)

    def _take_control(self) -> None:
        super()._take_control()
        if self._estimates_state:
            self._estimate = StateEstimate(self.model, self.data, self._imu)
        state = self._estimate.data if self._estimate else None
        self._walker = walker = walker_of(self.model, self.data, state)
        self._height = PhasedHeight(walker, self.stance_height, HeightLimits())
        if self._estimate:
            self._height.before_tick = self._estimate.tick
        self._upper_body = ReachingUpperBody(self.model, self.data)

    def _is_idle(self) -> bool:
        return self._estimate is None and super()._is_idle()

    def _follow(self, command: Command) -> None:
        if self.motors_enabled and command is not None:
            self._height.interrupt("a command to walk came")
        super()._follow(command)

    def _set_actuation(self, on: bool) -> None:
        super()._set_actuation(on)
        if not on:
            self._height.interrupt("the robot fell" if self._fallen else "the motors went off")
