"""One step in progress: when the swing foot lands, where, and the centre of pressure until then."""

from __future__ import annotations

from collections.abc import Sequence

from robot_sim.model.side import Side
from robot_sim.walking.balance_task import BalanceTask
from robot_sim.walking.dcm_plan import Point, cop_to_reach, dcm_after, time_to_reach
from robot_sim.walking.footsteps import Footstep
from robot_sim.walking.planar import Frame, clamp
from robot_sim.walking.sensing import Sensing
from robot_sim.walking.support import Support
from robot_sim.walking.swing import SwingReference, swing_reference
from robot_sim.walking.walker_parameters import WalkerParameters
from ros_runtime.angles import wrap

SHORTEST_REMAINDER = 0.06  # s until touchdown with which the CoP is computed; with less it would jump
SHORTEST_NOTICE = 0.05  # s from now to the earliest time to which touchdown can be moved
TIMING_PROGRESS = 0.8  # share of the swing; later the touchdown time is fixed
OVERDUE_SHARE = 1.4  # multiple of the swing duration; after that the foot counts as landed
SAFE_LEVER = 0.005  # m, least distance of DCM and CoP for which the step's timing can be computed
BEYOND_OUTER_EDGE = -0.75  # half-widths of the sole; a DCM below this is beyond the stance foot's edge


class StepInProgress:
    """A step from the shift of the load to the landing of the swing foot.

    Args:
        stance_side: the foot that stands.
        duration: until touchdown, s; adapted on the way.
        double_support: at the beginning, s, while the load moves to the stance foot.
        capture: the step catches a push, so its duration must not increase.
    """

    def __init__(
        self,
        stance_side: Side,
        duration: float,
        double_support: float,
        parameters: WalkerParameters,
        capture: bool = False,
    ) -> None:
        self.stance_side = stance_side
        self.swing_side = stance_side.other
        self.duration = duration
        self.double_support = double_support
        self.time = 0.0
        self.progress = 0.0
        self.in_swing = False
        self._out_of_reach = capture
        self._parameters = parameters
        self._support = Support(parameters.dimensions, parameters.balance)
        self._half_width = parameters.dimensions.sole_half_width
        self._outward = self.swing_side.sign
        self._cop_side = 0.0  # m, last lateral CoP, outward
        self._lift_off = Footstep(0.0, 0.0, 0.0)
        self._lift_off_height = 0.0

    def aim(self, footsteps: Sequence[Footstep], dcm_at_touchdown: Point) -> None:
        """Set the first of `footsteps` as the target, with that DCM (m) at touchdown."""
        self.target = footsteps[0]
        if self.time == 0.0:
            self._landing = self.target
        self.dcm_at_touchdown = dcm_at_touchdown

    def has_landed(self, sensed: Sensing) -> bool:
        """Return whether the swing foot bears load, or is long overdue."""
        if not self.in_swing:
            return False
        gait = self._parameters.gait
        touches = sensed.foot_loads[self.swing_side] > gait.touchdown_force
        overdue = self.time - self.double_support > OVERDUE_SHARE * (self.duration - self.double_support)
        return overdue or (touches and self.progress > gait.touchdown_progress)

    def advance(self, sensed: Sensing, cop_shift: Point, dt: float) -> BalanceTask:
        """Advance by one tick of `dt` (s) and return the task until the next one."""
        self.time += dt
        x, y, _ = sensed.soles[self.stance_side]
        stance = Frame(x, y, sensed.foot_yaws[self.stance_side], self._outward)
        if self.time > self.double_support and self.progress < TIMING_PROGRESS:
            self._adapt_duration(sensed, stance, dt)
        # The next stance foot takes over the DCM in the middle of the double support that follows.
        remaining = max(self.duration + self._parameters.gait.double_support / 2 - self.time, 0.0)
        cop = cop_to_reach(
            self.dcm_at_touchdown, sensed.dcm, sensed.omega, max(remaining, SHORTEST_REMAINDER)
        )
        cop = self._support.on_sole(cop, stance)
        self._cop_side = stance.local(*cop)[1]
        self._adapt_landing(sensed, stance, cop, remaining, dt)

        yaw = stance.yaw + wrap(self.target.yaw - stance.yaw) / 2
        if self.time < self.double_support:
            share = self.time / self.double_support
            left_share = share if self.stance_side is Side.LEFT else 1 - share
            cop = self._support.in_transfer(cop, sensed, stance.yaw, left_share)
            return BalanceTask(cop, yaw, left_share)
        cop = self._support.on_stance_foot(cop, stance, cop_shift)
        left_share = 1.0 if self.stance_side is Side.LEFT else 0.0
        return BalanceTask(cop, yaw, left_share, self._swing(sensed, dt))

    def _adapt_duration(self, sensed: Sensing, stance: Frame, dt: float) -> None:
        """Move touchdown to the time when the lateral DCM reaches its goal (Khadiv et al. 2016), at a limited rate.

        This keeps the robot from falling sideways. The foot cannot land inward of the stance foot, so if the DCM
        arrives early, the foot must land early.
        """
        gait = self._parameters.gait
        goal = stance.local(*self.dcm_at_touchdown)[1]
        dcm = stance.local(*sensed.dcm)[1]
        cop = self._cop_side
        rate = gait.timing_rate * dt
        earliest = self.time + SHORTEST_NOTICE
        if dcm - cop > SAFE_LEVER and goal - cop > SAFE_LEVER:
            arrival = self.time + time_to_reach(goal, dcm, cop, sensed.omega) - gait.double_support / 2
            wanted = max(clamp(arrival, gait.min_duration, gait.max_duration), earliest)
            if self._out_of_reach:
                wanted = min(wanted, self.duration)
            self.duration += clamp(wanted - self.duration, -rate, rate)
        elif dcm < BEYOND_OUTER_EDGE * self._half_width:
            # The DCM has passed the stance foot's outer edge: land soon, and make a step to that side.
            self.duration = max(self.duration - rate, gait.min_duration, earliest)

    def _adapt_landing(self, sensed: Sensing, stance: Frame, cop: Point, remaining: float, dt: float) -> None:
        """Shift the landing by the error of the predicted DCM, so that the next step begins as planned.

        As in Englsberger et al. 2015, this keeps the offset between foot and DCM at touchdown.
        """
        gait, limits = self._parameters.gait, self._parameters.steps
        x, y = self.target.x, self.target.y
        swinging = self.time >= self.double_support
        if swinging:
            predicted = dcm_after(sensed.dcm, cop, sensed.omega, remaining)
            x += predicted[0] - self.dcm_at_touchdown[0]
            y += predicted[1] - self.dcm_at_touchdown[1]
        forward, outward = stance.local(x, y)
        too_far = (
            forward > limits.reach_forward or forward < -limits.reach_backward or outward > limits.reach_outer
        )
        self._out_of_reach = swinging and too_far
        if self._out_of_reach and self.progress < TIMING_PROGRESS:
            sooner = self.duration - gait.timing_rate * dt
            self.duration = max(sooner, gait.min_duration, self.time + SHORTEST_NOTICE)
        if self.progress < gait.freeze_landing:
            x, y = stance.world(
                clamp(forward, -limits.reach_backward, limits.reach_forward),
                clamp(outward, limits.reach_inner, limits.reach_outer),
            )
            self._landing = Footstep(x, y, self.target.yaw)

    def _swing(self, sensed: Sensing, dt: float) -> SwingReference:
        """Advance the swing foot by one tick; the first call lifts it off the floor."""
        if not self.in_swing:
            self.in_swing = True
            x, y, self._lift_off_height = sensed.soles[self.swing_side]
            self._lift_off = Footstep(x, y, sensed.foot_yaws[self.swing_side])
        rate = (1 - self.progress) / max(self.duration - self.time, 0.02)
        self.progress = min(1.0, self.progress + rate * dt)
        return swing_reference(
            self.swing_side,
            self._lift_off,
            self._lift_off_height,
            self._landing,
            self._floor_at(self._landing, sensed),
            self._parameters.gait.step_height,
            self.progress,
            rate,
            overdue=self.time - self.duration,
            slope=sensed.slope,
        )

    def _floor_at(self, place: Footstep, sensed: Sensing) -> float:
        """Return the height (m) of the floor where the foot will land, inferred from the stance foot."""
        x, y, height = sensed.soles[self.stance_side]
        return height + sensed.slope[0] * (place.x - x) + sensed.slope[1] * (place.y - y)
