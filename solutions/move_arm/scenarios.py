"""What is done to a server that moves arms. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

from builtin_interfaces.msg import Duration
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from autograder.arena.stage import ActionClient, Goal, Stage
from humanoid_interfaces.action import MoveArm

SETTLING = 1.0  # s for joint_states and joint_limits to arrive
AFTERWARDS = 1.5  # s after a result in which nothing more may be published
WATCHING = 2.5  # s after a cancel in which the arm must stop and stay still
SOON = 8.0  # s for the result of a goal that was cancelled, blocked or replaced
UNDER_WAY = 0.3  # rad that the elbow has turned by when something happens to it
STARTING = 5.0  # s for a joint to get under way
JOINTS = [
    f"{side}_{joint}"
    for side in "lr"
    for joint in (
        *("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow"),
        *("wrist_yaw", "wrist_pitch", "wrist_roll"),
    )
]
ELBOW = -0.5  # rad, where both elbows are at first; the arms hang

Points = Sequence[tuple[float, Sequence[float]]]  # s, rad


def move(stage: Stage, arm: str, joints: Sequence[str], points: Points) -> None:
    """Move an arm through points and watch a little longer, also if the server thinks that it has arrived early."""
    move_arm, begin = _open(stage), time.monotonic()
    move_arm.send_and_wait(_goal(arm, joints, points), as_="move").wait_for_result()
    due = begin + points[-1][0]
    stage.wait(max(AFTERWARDS, due + AFTERWARDS - time.monotonic()))


def move_by_reversed_states(stage: Stage, arm: str, joints: Sequence[str], points: Points) -> None:
    """Move an arm while joint_states lists the joints in another order."""
    move_arm = _open(stage)
    stage.robot.reverse_joint_states()
    stage.robot.wait_for_commands()
    stage.wait(SETTLING)
    move_arm.send_and_wait(_goal(arm, joints, points), as_="move").wait_for_result()


def ask_for_the_impossible(stage: Stage) -> None:
    """Send goals with something wrong in each, by name."""
    move_arm = _open(stage, watched=False)
    two, there, further = ("l_elbow", "l_wrist_yaw"), (-0.8, 0.1), (-1.0, 0.2)
    ways: list[tuple[str, str, Sequence[str], Points]] = [
        ("no arm", "x", two, [(1.0, there)]),
        ("unknown joint", "l", ("l_elbow", "l_elbow_2"), [(1.0, there)]),
        ("other arm's joint", "l", ("l_elbow", "r_elbow"), [(1.0, (-0.8, -0.8))]),
        ("leg's joint", "l", ("l_elbow", "l_knee"), [(1.0, (-0.8, 0.8))]),
        ("no point", "l", two, []),
        ("too few positions", "l", two, [(1.0, there), (2.0, further[:1])]),
        ("too many positions", "l", two, [(1.0, (*there, 0.0)), (2.0, further)]),
        ("equal times", "l", two, [(1.0, there), (1.0, further)]),
        ("falling times", "l", two, [(1.0, there), (3.0, further), (2.0, there)]),
        ("NaN first", "l", two, [(1.0, (math.nan, 0.1)), (2.0, further)]),
        ("NaN last", "l", two, [(1.0, there), (2.0, (-1.0, math.nan))]),
        ("infinite", "l", two, [(1.0, (-0.8, -math.inf))]),
        ("above the range", "l", two, [(1.0, (0.2, 0.1)), (2.0, further)]),
        ("below the range", "l", two, [(1.0, there), (2.0, (-2.6, 0.2))]),
    ]
    for name, arm, joints, points in ways:
        move_arm.send_and_wait(_goal(arm, joints, points), as_=name)


def ask_at_the_ends_of_a_range(
    stage: Stage, arm: str, joint: str, inside: float, outside: Sequence[float], at: int
) -> None:
    """Send a trajectory with one position outside a joint's range, at one of its points; then one that fits."""
    move_arm = _open(stage)
    points = [(number + 1.0, [inside]) for number in range(3)]
    for number, position in enumerate(outside, start=1):
        wrong = [(t, [position] if n == at else place) for n, (t, place) in enumerate(points)]
        move_arm.send_and_wait(_goal(arm, [joint], wrong), as_=f"outside {number}")
    move_arm.send_and_wait(_goal(arm, [joint], points), as_="inside")


def block(stage: Stage, arm: str) -> None:
    """Hold the elbow on its way until the goal has ended, then let go."""
    elbow = f"{arm}_elbow"
    joints = [f"{arm}_shoulder_pitch", elbow, f"{arm}_wrist_pitch"]
    goal = _open(stage).send_and_wait(_goal(arm, joints, [(4.0, (0.0, ELBOW - 1.6, 0.2))]), as_="move")
    _let_it_move(stage, elbow)
    stage.robot.hold_joint(elbow)
    goal.wait_for_result(SOON)
    stage.wait(0.5)
    stage.robot.release_joint(elbow)
    stage.robot.wait_for_commands()
    stage.wait(WATCHING)


def hold_short(stage: Stage, goal_tolerance: float) -> None:
    """Hold the elbow shortly before its end, until the goal has ended."""
    _hold_short(stage, goal_tolerance)
    stage.wait(AFTERWARDS)


def let_go_in_time(stage: Stage, late: float) -> None:
    """Hold the elbow shortly before its end, and let go `late` s after the last point is due."""
    _hold_short(stage, 0.0, late)


def cancel(stage: Stage) -> None:
    """Cancel a goal while the arm moves, and watch the arm."""
    goal = _open(stage).send_and_wait(_far("l"), as_="move")
    _let_it_move(stage, "l_elbow")
    goal.cancel().wait()
    goal.wait_for_result(SOON)
    stage.wait(WATCHING)


def cancel_at_the_start(stage: Stage) -> None:
    """Cancel a goal as soon as it is accepted, before the arm has moved."""
    goal = _open(stage).send_and_wait(_far("l"), as_="move")
    goal.cancel().wait()
    goal.wait_for_result(SOON)
    stage.wait(WATCHING)


def cancel_and_move_again(stage: Stage, elbow: float) -> None:
    """Cancel a goal, then send another for the same arm."""
    move_arm = _open(stage)
    canceled = move_arm.send_and_wait(_far("l"), as_="canceled")
    _let_it_move(stage, "l_elbow")
    canceled.cancel().wait()
    canceled.wait_for_result(SOON)
    move_arm.send_and_wait(_goal("l", ["l_elbow"], [(2.0, [elbow])]), as_="again").wait_for_result()


def preempt(stage: Stage) -> None:
    """Send a second goal for an arm that moves."""
    move_arm = _open(stage)
    old = move_arm.send_and_wait(_far("l"), as_="old")
    _let_it_move(stage, "l_elbow")
    new = move_arm.send_and_wait(_goal("l", ["l_elbow", "l_wrist_yaw"], [(2.5, (-0.2, 0.4))]), as_="new")
    old.wait_for_result(SOON)
    new.wait_for_result()


def move_both(stage: Stage) -> None:
    """Send a goal for the right arm while the left one moves; the right one's is over first."""
    move_arm = _open(stage)
    left = move_arm.send_and_wait(_far("l"), as_="left")
    _let_it_move(stage, "l_elbow")
    right = move_arm.send_and_wait(
        _goal("r", ["r_elbow", "r_shoulder_pitch"], [(1.5, (-1.0, 0.0))]), as_="right"
    )
    right.wait_for_result()
    left.wait_for_result()


def cancel_one_of_two(stage: Stage) -> None:
    """Cancel the left arm's goal while both arms move."""
    move_arm = _open(stage)
    left = move_arm.send_and_wait(_far("l"), as_="left")
    right = move_arm.send_and_wait(_far("r"), as_="right")
    _let_it_move(stage, "l_elbow")
    _let_it_move(stage, "r_elbow")
    left.cancel().wait()
    left.wait_for_result(SOON)
    right.wait_for_result()
    stage.wait(WATCHING)


def lose_the_joint_states(stage: Stage) -> None:
    """Stop joint_states while the arm moves slowly."""
    goal = _open(stage).send_and_wait(_goal("l", ["l_elbow"], [(6.0, [ELBOW - 1.2])]), as_="move")
    _let_it_move(stage, "l_elbow")
    stage.robot.connect_joint_sensors(False)
    goal.wait_for_result(SOON)
    stage.wait(AFTERWARDS)


def interrupt(stage: Stage) -> None:
    """Press Ctrl-C while no goal is active."""
    _open(stage, watched=False)
    stage.interrupt_node()


def _open(stage: Stage, *, watched: bool = True) -> ActionClient:
    """Open the stage; `watched`: record what the arms do, and what is asked of them."""
    move_arm = stage.action("move_arm", MoveArm)
    if watched:
        stage.listen("joint_trajectory", JointTrajectory)
    stage.open()
    if watched:
        stage.robot.report_joints(JOINTS)
        stage.robot.wait_for_commands()
    stage.wait(SETTLING)
    return move_arm


def _goal(arm: str, joints: Sequence[str], points: Points, goal_tolerance: float = 0.0) -> MoveArm.Goal:
    trajectory = JointTrajectory(joint_names=list(joints))
    for seconds, positions in points:
        whole = math.floor(seconds)
        after = Duration(sec=whole, nanosec=round((seconds - whole) * 1e9))
        trajectory.points.append(JointTrajectoryPoint(positions=list(positions), time_from_start=after))
    return MoveArm.Goal(arm=arm, trajectory=trajectory, goal_tolerance=goal_tolerance)


def _far(arm: str) -> MoveArm.Goal:
    """A goal that bends an elbow slowly and far."""
    return _goal(arm, [f"{arm}_elbow", f"{arm}_wrist_pitch"], [(4.0, (ELBOW - 1.6, 0.3))])


def _let_it_move(stage: Stage, elbow: str) -> None:
    """Wait until an elbow is on its way."""
    stage.robot.wait_for_joint(elbow, lambda angle: angle < ELBOW - UNDER_WAY, STARTING)


def _hold_short(stage: Stage, goal_tolerance: float, late: float | None = None) -> Goal:
    """Send a goal, hold the elbow 0.3 rad before its end, and let go `late` s after the end, or never."""
    move_arm = _open(stage)
    begin, duration, end = time.monotonic(), 3.0, ELBOW - 1.2
    joints, points = ["l_shoulder_pitch", "l_elbow"], [(duration, (0.0, end))]
    goal = move_arm.send_and_wait(_goal("l", joints, points, goal_tolerance), as_="move")
    stage.robot.wait_for_joint("l_elbow", lambda angle: angle < end + 0.35, STARTING)
    stage.robot.hold_joint("l_elbow")
    if late is not None:
        stage.wait(max(0.0, begin + duration + late - time.monotonic()))
        stage.robot.release_joint("l_elbow")
    goal.wait_for_result(SOON)
    return goal
