"""What only the instructor's grading checks."""

from __future__ import annotations

import math

from autograder.authoring.checks import RESTING, Scenario, check
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.motion import require_limited_velocity, require_short_turn
from autograder.authoring.walking.truth import require_arrival

from .checks import arrives, obeys_max_velocity, rejects_a_wrong_frame


def _legs(random) -> dict:
    """Two poses, each with its limit (m/s): the robot turns its back, then goes on ahead and to one side.

    On the second leg its heading crosses pi. A velocity in odom's axes leads away from that pose, and one that is
    limited axis by axis is 1.4 times too fast.
    """
    side = random.choice((-1, 1))
    yaw = side * random.uniform(3.0, 3.05)
    x, y = random.uniform(0.3, 0.4), random.uniform(-0.2, 0.2)
    ahead, left = random.uniform(0.36, 0.4), -side * random.uniform(0.36, 0.4)
    second = (
        x + math.cos(yaw) * ahead - math.sin(yaw) * left,
        y + math.sin(yaw) * ahead + math.cos(yaw) * left,
        -side * random.uniform(3.0, 3.05),
    )
    legs = ((x, y, yaw, random.uniform(0.2, 0.3)), (*second, random.uniform(0.07, 0.08)))
    return {"legs": [[round(value, 3) for value in leg] for leg in legs]}


RANDOM_POSES = Scenario("walk_in_turn", _legs)
OTHER_FRAME = Scenario(
    "ask_for_the_impossible",
    lambda random: {"frame": random.choice(("base_link", "world", "odometry"))},
    robot=RESTING,
)
OTHER_NAMESPACE = Scenario(
    "walk", {"x": 0.3, "y": 0.0, "yaw": 0.0, "max_velocity": 0.3}, namespace="/lab_7/robot"
)


@check(points=2, on=RANDOM_POSES, needs=arrives, see="01_robot_and_graph#frames-intro")
def arrives_anywhere(run: Transcript) -> None:
    """It reaches poses with any heading, one after the other"""
    for number in range(1, len(run.params["legs"]) + 1):
        require_arrival(run.goal(f"leg {number}"))


@check(points=1, on=RANDOM_POSES, needs=arrives_anywhere, see="01_robot_and_graph#frames-intro")
def turns_the_shorter_way(run: Transcript) -> None:
    """It turns the shorter way round, also where the heading jumps from pi to -pi"""
    require_short_turn(run.goal("leg 2"))


@check(
    points=1,
    on=RANDOM_POSES,
    needs=[arrives_anywhere, obeys_max_velocity],
    see="01_robot_and_graph#frames-intro",
)
def obeys_any_max_velocity(run: Transcript) -> None:
    """It is no faster than max_velocity in any direction"""
    for number in range(1, len(run.params["legs"]) + 1):
        require_limited_velocity(run.goal(f"leg {number}"))


@check(points=1, on=OTHER_FRAME, needs=rejects_a_wrong_frame, see="06_walk_to_a_pose#reject-task")
def rejects_any_other_frame(run: Transcript) -> None:
    """It rejects a pose in any other frame than odom"""
    frame = run.params["frame"]
    run.goal("wrong frame").require_rejected(
        because=f"frame {frame!r} is not 'odom'",
        help="Accept the one frame that you know, 'odom', instead of rejecting those that you have thought of.",
    )


@check(points=1, on=OTHER_NAMESPACE, needs=arrives, see="01_robot_and_graph#names-why")
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it walks the robot there"""
    require_arrival(run.goal("walk"))
