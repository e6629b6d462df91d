"""The steps of scenarios for a pick_and_place server. No expected responses here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from geometry_msgs.msg import PoseStamped

from autograder.arena import events as ev
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Goal, Stage
from autograder.arena.units import Metres
from humanoid_interfaces.action import PickAndPlace

Place = Sequence[float]  # x, y m in odom; the height is that of a cup on the table
Condition = Callable[[ev.HandTruth, ev.ObjectTruth], bool]

ROBOT_TOPICS_TIME = 1.0  # s for messages of the robot to arrive, and for a moved cup to come to rest
RESULT_TIMEOUT = 60.0  # s for a goal
END_TIMEOUT = 15.0  # s for a goal that must end soon, and for every goal after a timeout in the scenario
HAND_TIMEOUT = 40.0  # s for the hand to fulfil a condition
ON_THE_TABLE = 0.755  # m, the height of the cup's centre
ASIDE = (0.50, 0.30, ON_THE_TABLE)  # m, out of the right hand's way
OPEN = 0.08  # m between the pads; a narrower hand is closing on the 6 cm wide cup
TOUCH_FORCE = 0.5  # N
JOINTS = [
    "waist_yaw",
    *(f"r_{part}" for part in ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow")),
    *(f"r_wrist_{axis}" for axis in ("yaw", "pitch", "roll")),
]


def in_order(stage: Stage, steps: Steps, watched: Sequence[str] = ("hand",)) -> None:
    """Send goals, wait for the hand, cancel, take the cup away, in the order of the steps.

    Args:
        stage: the arena.
        steps: each a verb from `_Table.vocabulary` with its arguments.
        watched: what to record: "hand" for the hand and the cup, "joints" for the joints of the arm.
    """
    table = _Table(stage)
    stage.open()
    if "hand" in watched:
        stage.robot.report_hand("r")
        stage.robot.report_object("cup")
    if "joints" in watched:
        stage.robot.report_joints(JOINTS)
    stage.robot.wait_for_commands()
    stage.wait(ROBOT_TOPICS_TIME)
    carry_out(stage, steps, table.vocabulary())


class _Table:
    """Sends named goals, cancels them, and disturbs the robot and the cup."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._action = stage.action("pick_and_place", PickAndPlace)
        self._goals: dict[str, Goal] = {}
        self._places: dict[str, Place] = {}
        self._timed_out = False

    def vocabulary(self) -> dict[str, Callable[..., object]]:
        robot = self._stage.robot
        return {
            "go": self.go,
            "arrive": self.arrive,
            "end": lambda name: self._goals[name].wait_for_result(END_TIMEOUT),
            "cancel": lambda name: self._goals[name].cancel().wait(),
            "wait_until": self.wait_until,
            "take_when": self.take_when,
            "put_cup": self.put_cup,
            "hold": robot.hold_joint,
            "release": robot.release_joint,
            "knock_over": lambda *impulse: robot.knock_over(impulse),
            "wait": self._stage.wait,
            "interrupt": self._stage.interrupt_node,
        }

    def go(
        self, name: str, place: Place, force: float = 10.0, thing: str = "cup", frame: str = "odom"
    ) -> None:
        """Send a goal, with a force in N, and wait until it is accepted or rejected."""
        pose = PoseStamped()
        pose.header.frame_id = frame
        pose.pose.position.x, pose.pose.position.y = place
        pose.pose.position.z = ON_THE_TABLE
        self._places[name] = place
        goal = PickAndPlace.Goal(object_id=thing, place_pose=pose, grasp_force=force)
        self._goals[name] = self._action.send_and_wait(goal, as_=name)

    def arrive(self, name: str) -> None:
        """Wait for the result of a goal; only briefly if the scenario has had a timeout before."""
        goal = self._goals[name]
        if goal.accepted and not goal.wait_for_result(END_TIMEOUT if self._timed_out else RESULT_TIMEOUT):
            self._timed_out = True

    def wait_until(self, what: str, name: str = "", way: float = 0.0) -> bool:
        """Wait until a condition holds; for 'carried', until the cup has gone a share (0 to 1) of a goal's way."""
        condition = self._carried(name, way) if what == "carried" else _CONDITIONS[what]
        has_come = self._stage.robot.wait_for_hand(
            condition, END_TIMEOUT if self._timed_out else HAND_TIMEOUT
        )
        self._timed_out = self._timed_out or not has_come
        return True

    def take_when(self, what: str, name: str = "", way: float = 0.0) -> bool:
        """Take the cup away when a condition holds (see `wait_until`); return whether it did."""
        self.wait_until(what, name, way)
        if not self._timed_out:
            self._stage.robot.move_object("cup", ASIDE)
        return not self._timed_out

    def put_cup(self, x: Metres, y: Metres) -> None:
        """Put the cup at a place (m in odom) on the table."""
        self._stage.robot.move_object("cup", (x, y, ON_THE_TABLE))
        self._stage.robot.wait_for_commands()
        self._stage.wait(ROBOT_TOPICS_TIME)

    def _carried(self, name: str, way: float) -> Condition:
        """Return the condition that the cup is lifted and has gone a share of its way to the goal's place."""
        place = self._places[name]
        lengths: list[float] = []

        def is_there(hand: ev.HandTruth, cup: ev.ObjectTruth) -> bool:
            left = math.dist(cup.position[:2], place)
            lengths.append(left)
            return _is_lifted(hand, cup) and left <= (1.0 - way) * lengths[0] + 0.02

        return is_there


def _is_lifted(hand: ev.HandTruth, cup: ev.ObjectTruth) -> bool:
    return cup.position[2] > ON_THE_TABLE + 0.04


_CONDITIONS: dict[str, Condition] = {
    "near": lambda hand, cup: math.dist(hand.position, cup.position) < 0.06,
    "closing": lambda hand, cup: math.dist(hand.position, cup.position) < 0.05 and hand.opening < OPEN,
    "touching": lambda hand, cup: min(hand.forces) > TOUCH_FORCE,
    "lifted": _is_lifted,
    "above the table": lambda hand, cup: hand.position[2] > ON_THE_TABLE - 0.03,
}
