"""The gait: standing, shifting the weight before the first step, and stepping."""

from __future__ import annotations

import math
from enum import Enum

from robot_sim.model.side import SIDES, Side
from robot_sim.walking.balance_task import BalanceTask
from robot_sim.walking.dcm_plan import dcm_at_touchdown, dcm_before
from robot_sim.walking.footsteps import Command, Footstep, Goal, Velocity, plan_footsteps
from robot_sim.walking.planar import Frame
from robot_sim.walking.sensing import Sensing
from robot_sim.walking.step_in_progress import StepInProgress
from robot_sim.walking.support import Support
from robot_sim.walking.walker_parameters import WalkerParameters
from ros_runtime.angles import wrap


class Phase(Enum):
    """What the feet are doing."""

    STAND = "stand"
    SHIFT = "shift"  # both feet stand, the DCM moves to where the first step begins
    STEP = "step"


class Gait:
    """The state machine that decides, tick by tick, which foot stands and where the CoP should be.

    Attributes:
        phase: what the feet are doing.
        steps: touchdowns so far.
        goal_reached: the last Goal was reached and no command has come since.
    """

    def __init__(self, parameters: WalkerParameters) -> None:
        self.phase = Phase.STAND
        self.steps = 0
        self.goal_reached = False
        self._parameters = parameters
        self._gait = parameters.gait
        self._support = Support(parameters.dimensions, parameters.balance)
        self._command: Command = None
        self._replan = False
        self._step: StepInProgress | None = None
        self._stance_side = Side.LEFT
        self._shift_time = 0.0

    def follow(self, command: Command) -> None:
        """Walk as `command` says from the next footstep on; None ends with the feet side by side."""
        if type(command) is not type(self._command) or command != self._command:
            self._command = command
            self._replan = True
            self.goal_reached = False

    @property
    def swing_side(self) -> Side | None:
        """The foot in the air, if any."""
        return self._step.swing_side if self._step is not None and self._step.in_swing else None

    @property
    def is_idle(self) -> bool:
        """Whether there is no command and no step in progress."""
        return self._command is None and self._step is None

    def update(self, sensed: Sensing, cop_shift: tuple[float, float], dt: float) -> BalanceTask:
        """Advance by one tick.

        Args:
            sensed: the robot's present state.
            cop_shift: offset (m) between the CoP that the whole-body controller last produced and the CoP of its task.
            dt: length of the tick, s.
        """
        if self._step is not None and self._step.has_landed(sensed):
            self._touch_down(self._step.swing_side, sensed)
        if self._step is None:
            self._catch_push(sensed)
        if self.phase is Phase.STAND:
            self._leave_stand(sensed)
        elif self.phase is Phase.SHIFT and self._command is None:
            self.phase = Phase.STAND
        if self._step is not None:
            if self._replan and self._step.progress < 0.5:
                self._plan(sensed)
            return self._step.advance(sensed, cop_shift, dt)
        if self.phase is Phase.SHIFT:
            return self._shift(sensed, cop_shift, dt)
        return self._stand(sensed, cop_shift)

    def _stand(self, sensed: Sensing, cop_shift: tuple[float, float]) -> BalanceTask:
        """Hold the DCM over the middle of the feet."""
        x, y, yaw = sensed.feet_centre
        return self._hold_dcm(x, y, yaw, self._parameters.balance.stand_gain, sensed, cop_shift)

    def _hold_dcm(
        self,
        x: float,
        y: float,
        yaw: float,
        gain: float,
        sensed: Sensing,
        cop_shift: tuple[float, float],
    ) -> BalanceTask:
        """Return the task that brings the DCM to (x, y): p = ξ + k (ξ - ξ_ref) gives ξ̇ = -ω k (ξ - ξ_ref)."""
        dcm_x, dcm_y = sensed.dcm
        cop = dcm_x + gain * (dcm_x - x), dcm_y + gain * (dcm_y - y)
        return BalanceTask(self._support.between_feet(cop, sensed, cop_shift), yaw)

    def _leave_stand(self, sensed: Sensing) -> None:
        """Begin to walk if there is a command."""
        if self._arrived(sensed):
            self._command, self.goal_reached = None, True
        if self._command is not None:
            self._stance_side = self._first_stance(sensed)
            self.phase, self._shift_time = Phase.SHIFT, 0.0
            self._plan(sensed)

    def _catch_push(self, sensed: Sensing) -> None:
        """Begin a step at once if a push has lifted a foot or moved the DCM too far to hold it with both feet."""
        gait = self._gait
        lifted = self._lifted_foot(sensed)
        forward, left = Frame(*sensed.feet_centre).local(*sensed.dcm)
        if lifted is not None:
            self._stance_side = lifted.other
            self._begin_step(gait.capture_duration, 0.0, sensed, capture=True)
        elif abs(forward) > gait.capture_forward or abs(left) > gait.capture_sideways:
            self._stance_side = Side.RIGHT if left <= -0.04 else Side.LEFT
            self._begin_step(gait.capture_duration, gait.capture_double_support, sensed, capture=True)

    def _lifted_foot(self, sensed: Sensing) -> Side | None:
        for side in SIDES:
            height = sensed.soles[side][2] - sensed.soles[side.other][2]
            if height > self._gait.lifted_height and sensed.foot_loads[side] < self._gait.touchdown_force:
                return side
        return None

    def _first_stance(self, sensed: Sensing) -> Side:
        """Return the foot to stand on first: the one away from where the body goes."""
        left = turn = 0.0
        if isinstance(self._command, Velocity):
            left, turn = self._command.vy, self._command.wz
        elif isinstance(self._command, Goal):
            _, left = Frame(*sensed.feet_centre).local(self._command.x, self._command.y)
            left = left if abs(left) > 0.02 else 0.0
            turn = wrap(self._command.yaw - sensed.feet_centre[2])
        return Side.RIGHT if left > 0 or (left == 0 and turn > 0) else Side.LEFT

    def _shift(self, sensed: Sensing, cop_shift: tuple[float, float], dt: float) -> BalanceTask:
        """Bring the DCM to where a step with the CoP at the stance foot begins; then lift the other foot."""
        if self._replan:
            self._plan(sensed)
        self._shift_time += dt
        x, y, _ = sensed.soles[self._stance_side]
        start = dcm_before(self._dcm_at_touchdown, (x, y), sensed.omega, self._gait.duration)
        error = math.hypot(sensed.dcm[0] - start[0], sensed.dcm[1] - start[1])
        settled = error < self._gait.shift_tolerance and self._shift_time > self._gait.shift_min_time
        if settled or self._shift_time > self._gait.shift_max_time:
            step = self._begin_step(self._gait.duration - self._gait.double_support, 0.0, sensed)
            return step.advance(sensed, cop_shift, dt)
        return self._hold_dcm(*start, sensed.feet_centre[2], self._gait.shift_gain, sensed, cop_shift)

    def _begin_step(
        self, duration: float, double_support: float, sensed: Sensing, capture: bool = False
    ) -> StepInProgress:
        self.phase = Phase.STEP
        self._step = StepInProgress(self._stance_side, duration, double_support, self._parameters, capture)
        self._plan(sensed)
        return self._step

    def _touch_down(self, side: Side, sensed: Sensing) -> None:
        """Handle the landing of a foot: stand if there is no command left and it is safe, else begin another step."""
        self.steps += 1
        self._stance_side = side
        arrived = self._arrived(sensed)
        if (self._command is None or arrived) and self._can_stand(sensed):
            self.phase, self._step = Phase.STAND, None
            self._command, self.goal_reached = None, arrived or self.goal_reached
            return
        self._begin_step(self._gait.duration, self._gait.double_support, sensed)

    def _can_stand(self, sensed: Sensing) -> bool:
        """Return whether the feet are side by side and the DCM is near enough to their middle to be held there."""
        gait = self._gait
        centre = Frame(*sensed.feet_centre)
        forward, left = centre.local(*sensed.dcm)
        left_foot = centre.local(*sensed.soles[Side.LEFT][:2])
        return (
            abs(forward) < gait.stand_dcm_forward
            and abs(left) < gait.stand_dcm_sideways
            and abs(2 * left_foot[0]) < gait.stand_feet_offset
            and abs(2 * left_foot[1] - gait.feet_width) < gait.stand_feet_width
        )

    def _arrived(self, sensed: Sensing) -> bool:
        if not isinstance(self._command, Goal):
            return False
        x, y, yaw = sensed.feet_centre
        distance = math.hypot(self._command.x - x, self._command.y - y)
        turn = abs(wrap(self._command.yaw - yaw))
        return distance < self._gait.goal_tolerance and turn < self._gait.goal_yaw_tolerance

    def _plan(self, sensed: Sensing) -> None:
        """Plan footsteps from the stance foot as it stands, and the DCM they need."""
        x, y, _ = sensed.soles[self._stance_side]
        stance = Footstep(x, y, sensed.foot_yaws[self._stance_side])
        footsteps = plan_footsteps(
            self._command, stance, self._stance_side, self._gait, self._parameters.steps
        )
        self._dcm_at_touchdown = dcm_at_touchdown(footsteps, sensed.omega, self._gait.duration)
        if self._step is not None:
            self._step.aim(footsteps, self._dcm_at_touchdown)
        self._replan = False
