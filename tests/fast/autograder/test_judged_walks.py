"""A walk is judged by the simulator's poses of the robot over time, and by the server's commands."""

from __future__ import annotations

import math

import pytest
from geometry_msgs.msg import Twist

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, Failure
from autograder.authoring.walking.motion import (
    require_limited_velocity,
    require_reached,
    require_short_turn,
)
from autograder.authoring.walking.obligations.walks import (
    does_not_steer_without_a_goal,
    ends_with_a_zero_twist,
    stands_at_success,
)
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from records import failure_of, robot
from ros_runtime.message_constants import GoalStatus

PERIOD = 0.02  # s between two samples of the robot
AFTERWARDS = 1.5  # s


def walked(motion, seconds, *, goal_yaw=0.0, max_velocity=0.1, still_moving=0.0, commands=()):
    """A walk to x = 1 m whose robot is at motion(s) -> (x, yaw), and which SUCCEEDS after so many seconds.

    `still_moving` is its speed (m/s) afterwards; `commands` are (s after the result, m/s forward).
    """
    request = WalkTo.Goal(max_velocity=max_velocity)
    pose = request.target_pose.pose
    pose.position.x = 1.0
    pose.orientation.z, pose.orientation.w = math.sin(goal_yaw / 2), math.cos(goal_yaw / 2)
    events = [
        ev.NodeStarted(t=0.0),
        ev.GoalSent(t=0.0, goal="walk", action="walk_to", request=request),
        ev.GoalAnswered(t=0.0, goal="walk", accepted=True),
        ev.ResultReceived(t=seconds, goal="walk", status=GoalStatus.SUCCEEDED, result=WalkTo.Result()),
        ev.ScenarioEnded(t=seconds + AFTERWARDS),
    ]
    for after, forward in commands:
        message = Twist()
        message.linear.x = forward
        events.append(ev.MessageReceived(t=seconds + after, topic="cmd_vel", message=message))
    for k in range(round((seconds + AFTERWARDS) / PERIOD) + 1):
        t = k * PERIOD
        x, yaw = motion(min(t, seconds))
        speed = 0.2 if t < seconds else still_moving
        mode = RobotState.WALKING if speed else RobotState.STANDING
        events.append(robot(t, mode=mode, x=x, yaw=yaw, speed=speed))
    return Transcript.from_events("walk", {}, events)


def straight(velocity):
    return lambda t: (min(1.0, velocity * t), 0.0)


def test_a_walk_is_as_fast_as_it_may_be():
    run = walked(straight(0.1), 12.0)
    assert require_reached(run.goal("walk")).x == pytest.approx(0.9, abs=0.01)
    require_limited_velocity(run.goal("walk"))
    require_limited_velocity(walked(straight(0.109), 12.0).goal("walk"))


@pytest.mark.parametrize(
    ("velocity", "advice"), [(0.14, "linear.x and linear.y together"), (0.35, "Read goal_handle")]
)
def test_a_walk_that_is_too_fast_is_reported_with_the_excess(velocity, advice):
    with pytest.raises(Failure, match=f"{velocity:.3f} m/s") as failed:
        require_limited_velocity(walked(straight(velocity), 12.0).goal("walk"))
    assert advice in failed.value.help


@pytest.mark.parametrize(
    ("motion", "advice"),
    [
        (lambda t: (0.0, 0.0), "It stayed where it was"),
        (lambda t: (-0.1 * t, 0.0), "not toward the goal"),
        (lambda t: (min(0.5, 0.1 * t), 0.0), "stopped too early"),
        (lambda t: (min(1.0, 0.1 * t), 1.0), "right heading"),
    ],
)
def test_a_robot_that_does_not_arrive_is_reported_with_its_motion(motion, advice):
    assert advice in failure_of(require_reached, walked(motion, 12.0).goal("walk")).help


def test_the_shorter_way_round_crosses_pi():
    turning = walked(lambda t: (1.0, 3.0 + 0.1 * min(t, 2.8)), 5.0, goal_yaw=-3.0)
    require_short_turn(turning.goal("walk"))
    with pytest.raises(Failure, match="the longer way round"):
        require_short_turn(walked(lambda t: (1.0, 3.0 - 1.2 * t), 5.0, goal_yaw=-3.0).goal("walk"))


def test_a_walk_ends_with_a_zero_twist():
    run = walked(straight(0.1), 12.0, commands=[(-2.0, 0.1), (-1.0, 0.0), (0.1, 0.0)])
    ends_with_a_zero_twist(run.goal("walk"))


@pytest.mark.parametrize(
    ("commands", "seen"),
    [
        ([(-1.0, 0.1)], "x 0.10 m/s"),
        ([(0.2, 0.0)], "none"),
    ],
)
def test_without_a_zero_twist_a_walk_has_no_end(commands, seen):
    run = walked(straight(0.1), 12.0, commands=commands)
    with pytest.raises(Failure, match=seen):
        ends_with_a_zero_twist(run.goal("walk"))


def test_a_twist_after_the_end_steers_without_a_goal():
    run = walked(straight(0.1), 12.0, commands=[(-1.0, 0.0), (1.0, 0.1)])
    with pytest.raises(Failure, match=r"x 0\.10 m/s"):
        does_not_steer_without_a_goal(run)


def test_without_any_twist_the_check_does_not_pass():
    run = walked(straight(0.1), 12.0)
    with pytest.raises(CannotBeJudged):
        ends_with_a_zero_twist(run.goal("walk"))


def test_success_comes_when_the_robot_stands():
    stands_at_success(walked(straight(0.1), 12.0).goal("walk"))
    with pytest.raises(Failure, match=r"0\.20 m/s"):
        stands_at_success(walked(straight(0.1), 12.0, still_moving=0.2).goal("walk"))
