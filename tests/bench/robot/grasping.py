"""Taking the cup from the table and putting it down, for the trials; each step returns whether it worked."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from bench.robot.reach import HandTarget
from bench.robot.trial import simulate
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.model.joint_names import arm_joints
from robot_sim.model.side import Side

SIDE = Side.RIGHT
READY = (0.7, -0.15, 0.0, -2.1, 0.0, 0.0, 0.0)  # rad, the hand beside the body and above the table
READY_TIME = 1.0  # s
FINGERS_FORWARD = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])  # the hand's axes, x ahead
APPROACH = 0.10  # m, from where the hand goes to the object in a straight line
GRIP_ABOVE_CENTRE = 0.01  # m
CLOSED_FORCE = 8.0  # N, of both fingers, felt before lifting
FIRM_GRIP = 0.035  # m, opening asked for around a cup of 6 cm
LIFT = 0.12  # m
PLACED_WITHIN = 0.03  # m


class Grasp:
    """One hand and the cup.

    Attributes:
        robot: whose hand.
        heading: rad, the way the hand points.
    """

    def __init__(self, robot: TrialHumanoid) -> None:
        self.robot = robot
        self.heading = 0.0
        self._hand = robot.hands[SIDE]

    def cup(self) -> np.ndarray:
        """Return where the cup is, (3,) m."""
        return self.robot.object_poses()["cup"].position

    def take(self) -> str:
        """Grasp the cup and lift it; return what went wrong, or ""."""
        self.get_ready()
        if not self.approach():
            return "the hand did not reach the cup"
        if not self.close():
            return "the fingers did not close on the cup"
        self.lift()
        return ""

    def get_ready(self) -> None:
        """Open the hand and lift it above the table."""
        self._hand.open_to(0.09)
        at_rest = (0.0,) * len(READY)
        self.robot.move_joints(
            JointTrajectory(tuple(arm_joints(SIDE)), (Waypoint(READY_TIME, READY, at_rest),))
        )
        simulate(self.robot, READY_TIME + 0.2)

    def approach(self) -> bool:
        """Bring the open hand around the cup."""
        cup = self.cup()
        self.heading = self._heading_for(cup[0], cup[1])
        target = cup + np.array([0.0, 0.0, GRIP_ABOVE_CENTRE])
        back = self.move_to(target - APPROACH * self._ahead(), speed=0.3, within=0.008, turned=0.08)
        return back and self.move_to(target, speed=0.12, within=0.006)

    def close(self) -> bool:
        """Close the fingers until both press, then hold the cup with a firm, limited grip."""
        self._hand.open_to(0.0)
        felt = simulate(self.robot, 0.6, until=lambda: self._hand.grip_force > CLOSED_FORCE)
        self._hand.open_to(FIRM_GRIP)
        simulate(self.robot, 0.3)
        return felt

    def lift(self) -> None:
        """Lift the cup."""
        grip = self.grip_point() + np.array([0.0, 0.0, LIFT])
        self.move_to(grip, speed=0.15, within=0.005)
        simulate(self.robot, 0.4)

    def holds(self) -> bool:
        """Return whether both fingers feel the cup."""
        return self._hand.grip_force > 1.0

    def slip(self) -> Callable[[], float]:
        """Return a function that tells how far (m) the cup has moved in the hand since now."""
        before = self._cup_in_hand()
        return lambda: float(np.linalg.norm(self._cup_in_hand() - before))

    def put_down(self, x: float, y: float, height: float) -> tuple[float, str]:
        """Put the cup down at (x, y, height) m; return how far (m) from there it stands, and what is wrong or ""."""
        self._place(x, y, height)
        simulate(self.robot, 0.5)
        cup = self.robot.object_poses()["cup"].position
        error = math.hypot(cup[0] - x, cup[1] - y)
        if abs(cup[2] - height) > 0.01:
            return error, f"the cup is {cup[2] - height:.3f} m above the table"
        return error, f"placed {error:.3f} m away" if error > PLACED_WITHIN else ""

    def _place(self, x: float, y: float, height: float) -> None:
        """Put the cup down with its centre at (x, y, height) m, corrected by its measured place."""
        self.heading = self._heading_for(x, y)
        above = np.array([x, y, height + LIFT]) + self.grip_point() - self.cup()
        self.move_to(above, speed=0.2, within=0.01)
        simulate(self.robot, 0.4)
        seen = self.cup()
        grip = self.grip_point()
        down = np.array([grip[0] + x - seen[0], grip[1] + y - seen[1], grip[2] + height - seen[2] + 0.002])
        self.move_to(down, speed=0.08, within=0.004, until=lambda: self.cup()[2] < height + 0.004)
        simulate(self.robot, 0.2)
        self._hand.open_to(0.09)
        simulate(self.robot, 0.5)
        self.move_to(self.grip_point() - 0.12 * self._ahead(), speed=0.15, within=0.01)

    def move_to(
        self,
        position: np.ndarray,
        *,
        speed: float,
        within: float,
        turned: float = math.inf,
        until: Callable[[], bool] | None = None,
    ) -> bool:
        """Move the grip point to `position` (3,) m; return whether it came `within` (m) in time."""
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        rotation = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]) @ FINGERS_FORWARD
        x, y, z = position.tolist()
        reach = self.robot.reach(SIDE, HandTarget((x, y, z), rotation, speed, with_waist=True))
        limit = 2.0 + reach.error() / speed

        def there() -> bool:
            return (reach.error() < within and reach.rotation_error() < turned) or bool(until and until())

        return simulate(self.robot, limit, until=there)

    def grip_point(self) -> np.ndarray:
        """Return where the fingers meet, (3,) m."""
        return self.robot.data.site(f"{SIDE.letter}_grip").xpos.copy()

    def _heading_for(self, x: float, y: float) -> float:
        """Return half of the bearing from the shoulder, which turns the wrist less than the whole bearing."""
        shoulder = self.robot.data.body(f"{SIDE.letter}_shoulder_pitch_link").xpos
        return 0.5 * math.atan2(y - shoulder[1], x - shoulder[0])

    def _ahead(self) -> np.ndarray:
        return np.array([math.cos(self.heading), math.sin(self.heading), 0.0])

    def _cup_in_hand(self) -> np.ndarray:
        rotation = self.robot.data.site(f"{SIDE.letter}_grip").xmat.reshape(3, 3)
        return rotation.T @ (self.cup() - self.grip_point())
