"""What is done to a server that picks and places. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry_msgs.msg import PoseStamped

from autograder.arena import events as ev
from autograder.arena.stage import ActionClient, Stage
from humanoid_interfaces.action import PickAndPlace

Place = Sequence[float]  # x, y m in odom; the height is that of a cup on the table

SETTLING = 1.0  # s for the robot's topics to arrive, and for a moved cup to stand
AFTERWARDS = 1.5  # s after a result in which nothing more may happen
WHOLE = 60.0  # s for a goal
STARTING = 40.0  # s until the hand has come somewhere
ON_THE_TABLE = 0.755  # m, the height of the cup's centre
ASIDE = (0.50, 0.30, ON_THE_TABLE)  # m, out of the right hand's way
OPEN = 0.08  # m between the pads; narrower is closing around a cup of 6 cm
TOUCHED = 0.5  # N
JOINTS = [
    "waist_yaw",
    *(f"r_{part}" for part in ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow")),
    *(f"r_wrist_{axis}" for axis in ("yaw", "pitch", "roll")),
]


def fetch(stage: Stage, place: Place, force: float, cup: Place | None = None) -> None:
    """Have the cup put down at a place, held with so much force (N); `cup`: where it stands at first."""
    goal = _open(stage, cup).send_and_wait(_goal(place, force), as_="fetch")
    goal.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def fetch_twice(stage: Stage, places: Sequence[Place], force: float) -> None:
    """Have the cup put down at two places, one after the other: goals 'fetch 1' and 'fetch 2'."""
    server = _open(stage)
    for number, place in enumerate(places, start=1):
        goal = server.send_and_wait(_goal(place, force), as_=f"fetch {number}")
        if not goal.wait_for_result(WHOLE):
            return
    stage.wait(AFTERWARDS)


def ask_for_the_impossible(stage: Stage) -> None:
    """Send goals with something wrong in each, by name."""
    server = _open(stage, watched=False)
    here = (0.33, -0.25)
    wrong = {
        "wrong frame": _goal(here, frame="map"),
        "no frame": _goal(here, frame=""),
        "NaN place": _goal((math.nan, -0.25)),
        "infinite place": _goal((0.33, -math.inf)),
        "NaN force": _goal(here, math.nan),
        "no force": _goal(here, 0.0),
        "negative force": _goal(here, -8.0),
        "too much force": _goal(here, 40.0),
    }
    for name, goal in wrong.items():
        server.send_and_wait(goal, as_=name)
    stage.wait(AFTERWARDS)


def ask_for_the_unknown(stage: Stage, objects: Sequence[str]) -> None:
    """Ask for objects that are not there, one after the other: goals 'unknown 1', 'unknown 2', …"""
    server = _open(stage, watched=False)
    for number, name in enumerate(objects, start=1):
        goal = server.send_and_wait(_goal((0.33, -0.25), name=name), as_=f"unknown {number}")
        if not goal.wait_for_result(WHOLE):
            return


def ask_for_the_far(stage: Stage, place: Place, cup: Place | None = None) -> None:
    """Ask for a place, or for a cup, beyond the hand's reach."""
    server = _open(stage, cup)
    stage.robot.report_joints(JOINTS)
    stage.robot.wait_for_commands()
    goal = server.send_and_wait(_goal(place), as_="far")
    goal.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def take_away(stage: Stage, cup: Place | None = None) -> None:
    """Take the cup away when the hand begins to close around it."""
    goal = _open(stage, cup).send_and_wait(_goal((0.35, -0.27)), as_="fetch")
    if stage.robot.wait_for_hand(_closes, STARTING):
        stage.mark("taken")
        stage.robot.move_object("cup", ASIDE)
    goal.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def snatch(stage: Stage, way: float) -> None:
    """Take the cup out of the hand when it has been lifted, and carried so much (0..1) of its way."""
    cup, place = (0.32, -0.10), (0.34, -0.28)
    goal = _open(stage, cup).send_and_wait(_goal(place), as_="fetch")
    if _let_it_carry(stage, cup, place, way):
        stage.mark("taken")
        stage.robot.move_object("cup", ASIDE)
    goal.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def cancel_before_the_grasp(stage: Stage, closing: bool) -> None:
    """Cancel when the hand comes near the cup, or when its fingers have just touched it."""
    goal = _open(stage).send_and_wait(_goal((0.35, -0.27)), as_="fetch")
    stage.robot.wait_for_hand(_touches if closing else _approaches, STARTING)
    goal.cancel().wait()
    goal.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def cancel_while_holding(stage: Stage, cup: Place, place: Place, way: float) -> None:
    """Cancel when the cup has been lifted, and carried so much (0..1) of its way."""
    goal = _open(stage, cup).send_and_wait(_goal(place), as_="fetch")
    _let_it_carry(stage, cup, place, way)
    goal.cancel().wait()
    goal.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def cancel_and_fetch_again(stage: Stage, place: Place, force: float) -> None:
    """Cancel a goal before the grasp, then send another."""
    server = _open(stage)
    canceled = server.send_and_wait(_goal((0.35, -0.27)), as_="canceled")
    stage.robot.wait_for_hand(_approaches, STARTING)
    canceled.cancel().wait()
    canceled.wait_for_result(WHOLE)
    server.send_and_wait(_goal(place, force), as_="fetch").wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def ask_for_two(stage: Stage) -> None:
    """Send a second goal while the cup hangs in the hand."""
    server = _open(stage)
    first = server.send_and_wait(_goal((0.35, -0.27)), as_="first")
    stage.robot.wait_for_hand(_is_lifted, STARTING)
    second = server.send_and_wait(_goal((0.34, -0.10)), as_="second")
    first.wait_for_result(WHOLE)
    if second.accepted:
        second.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def block(stage: Stage) -> None:
    """Hold the elbow from when the hand is above the table, until the goal has ended."""
    goal = _open(stage).send_and_wait(_goal((0.35, -0.27)), as_="fetch")
    stage.robot.wait_for_hand(lambda hand, cup: hand.position[2] > ON_THE_TABLE - 0.03, STARTING)
    stage.robot.hold_joint("r_elbow")
    goal.wait_for_result(WHOLE)
    stage.robot.release_joint("r_elbow")
    stage.wait(AFTERWARDS)


def fall(stage: Stage, impulse: tuple[float, float, float]) -> None:
    """Knock the robot over (N·s in odom) while it reaches for the cup."""
    goal = _open(stage).send_and_wait(_goal((0.35, -0.27)), as_="fetch")
    stage.robot.wait_for_hand(_approaches, STARTING)
    stage.robot.knock_over(impulse)
    goal.wait_for_result(15.0)


def interrupt(stage: Stage) -> None:
    """Press Ctrl-C while no goal is active."""
    _open(stage, watched=False)
    stage.interrupt_node()


def _open(stage: Stage, cup: Place | None = None, *, watched: bool = True) -> ActionClient:
    """Open the stage, with the cup at a place of its own; `watched`: record what hand and cup do."""
    server = stage.action("pick_and_place", PickAndPlace)
    stage.open()
    if watched:
        _watch(stage, cup)
    stage.wait(SETTLING)
    return server


def _watch(stage: Stage, cup: Place | None) -> None:
    stage.robot.report_hand("r")
    stage.robot.report_object("cup")
    if cup is not None:
        stage.robot.move_object("cup", (*cup, ON_THE_TABLE))
    stage.robot.wait_for_commands()


def _goal(place: Place, force: float = 10.0, frame: str = "odom", name: str = "cup") -> PickAndPlace.Goal:
    pose = PoseStamped()
    pose.header.frame_id = frame
    pose.pose.position.x, pose.pose.position.y = place
    pose.pose.position.z = ON_THE_TABLE
    return PickAndPlace.Goal(object_id=name, place_pose=pose, grasp_force=force)


def _approaches(hand: ev.HandTruth, cup: ev.ObjectTruth) -> bool:
    return math.dist(hand.position, cup.position) < 0.06


def _closes(hand: ev.HandTruth, cup: ev.ObjectTruth) -> bool:
    return math.dist(hand.position, cup.position) < 0.05 and hand.opening < OPEN


def _touches(hand: ev.HandTruth, cup: ev.ObjectTruth) -> bool:
    return min(hand.forces) > TOUCHED


def _is_lifted(hand: ev.HandTruth, cup: ev.ObjectTruth) -> bool:
    return cup.position[2] > ON_THE_TABLE + 0.04


def _let_it_carry(stage: Stage, cup: Place, place: Place, way: float) -> bool:
    """Wait until the cup has been lifted, and carried so much (0..1) of its way; return whether it was."""
    length = math.dist(cup, place)

    def is_there(hand: ev.HandTruth, thing: ev.ObjectTruth) -> bool:
        left = math.dist(thing.position[:2], place)
        return _is_lifted(hand, thing) and left <= (1.0 - way) * length + 0.02

    return stage.robot.wait_for_hand(is_there, STARTING)
