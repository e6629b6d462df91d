"""Messages in words."""

from __future__ import annotations

from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import BatteryState, JointState
from std_srvs.srv import Trigger

from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.srv import AddTwoInts
from lab import describe
from lab.client.formatting import describe_briefly


def test_numbers_are_short_and_nan_is_named() -> None:
    words = describe(BatteryState(percentage=0.123456, voltage=float("nan")))
    assert "percentage 0.123," in words
    assert "voltage NaN," in words
    assert "header" not in words


def test_a_pose_is_x_y_and_heading() -> None:
    result = WalkTo.Result(final_pose=PoseStamped())
    result.final_pose.pose.position.x = 1.5
    result.final_pose.pose.orientation.z = result.final_pose.pose.orientation.w = 0.5**0.5
    assert "final_pose (1.50 m, 0.00 m, 90°)" in describe(result)


def test_a_duration_is_in_seconds() -> None:
    feedback = WalkTo.Feedback()
    feedback.estimated_time_remaining.sec, feedback.estimated_time_remaining.nanosec = 2, 500_000_000
    assert "estimated_time_remaining 2.5 s" in describe(feedback)


def test_long_lists_are_counted() -> None:
    assert "position [5 values], velocity [1]" in describe(JointState(position=[0.0] * 5, velocity=[1.0]))


def test_an_empty_message_is_empty() -> None:
    assert describe(Trigger.Request()) == "empty"


def test_an_arrow_leaves_out_zeros_and_the_names_of_poses() -> None:
    goal = WalkTo.Goal(max_velocity=0.3)
    goal.target_pose.pose.position.x = 1.0
    assert describe_briefly(goal) == "(1.00 m, 0.00 m, 0°), max_velocity 0.3"
    assert describe_briefly(WalkTo.Goal()) == "(0.00 m, 0.00 m, 0°)"
    assert describe_briefly(AddTwoInts.Response()) == "sum 0"
