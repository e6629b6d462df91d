"""Messages that are typed and printed as YAML."""

from __future__ import annotations

from typing import Any

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, Twist
from sensor_msgs.msg import BatteryState, JointState
from std_msgs.msg import Bool, String
from trajectory_msgs.msg import JointTrajectory

from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.srv import AddTwoInts
from ros_cli.errors import CommandError
from ros_cli.yaml_values import message_from_yaml, message_to_yaml


@pytest.mark.parametrize(
    ("message_type", "text", "field", "expected"),
    [
        (Twist, "{linear: {x: 1}}", "linear.x", 1.0),
        (Twist, "linear:\n  x: 1e-3", "linear.x", 0.001),
        (String, "data: 5", "data", "5"),
        (Bool, "{data: true}", "data", True),
        (Bool, "{data: 1}", "data", True),
        (BatteryState, "{percentage: .nan}", "voltage", 0.0),
        (JointState, "{name: [knee], position: [1, 0.5]}", "name", ["knee"]),
        (AddTwoInts.Request, "{a: -3}", "a", -3),
        (AddTwoInts.Request, "", "a", 0),
    ],
)
def test_typed_yaml_becomes_the_message(message_type: Any, text: str, field: str, expected: Any) -> None:
    value = message_from_yaml(message_type, text)
    for name in field.split("."):
        value = getattr(value, name)
    assert value == expected


def test_messages_in_sequences_are_filled() -> None:
    text = "{joint_names: [neck], points: [{positions: [1], time_from_start: {sec: 2}}]}"
    [point] = message_from_yaml(JointTrajectory, text).points
    assert list(point.positions) == [1.0]
    assert point.time_from_start.sec == 2


def test_auto_and_now_stand_for_the_time_of_publishing() -> None:
    now = Time(sec=7)
    assert message_from_yaml(PoseStamped, "{header: auto}", now=now).header.stamp == now
    assert message_from_yaml(PoseStamped, "{header: {stamp: now}}", now=now).header.stamp == now
    nested = message_from_yaml(WalkTo.Goal, "{target_pose: {header: {stamp: now, frame_id: odom}}}", now=now)
    assert (nested.target_pose.header.stamp, nested.target_pose.header.frame_id) == (now, "odom")
    assert message_from_yaml(PoseStamped, "{header: auto}").header.stamp == Time()


def test_no_other_word_stands_for_a_time() -> None:
    with pytest.raises(CommandError, match="nanosec: …}, got 'auto'"):
        message_from_yaml(PoseStamped, "{header: {stamp: auto}}", now=Time(sec=7))


@pytest.mark.parametrize(
    ("message_type", "text", "error_text"),
    [
        (AddTwoInts.Request, "{c: 1}", "no field 'c'; it has a, b"),
        (AddTwoInts.Request, "{a:1}", "a space follows each colon"),
        (AddTwoInts.Request, "{a: word}", "'a' field"),
        (AddTwoInts.Request, "[1, 2]", "needs to be a dictionary in YAML format"),
        (AddTwoInts.Request, "{a: 1", "is not YAML"),
        (Twist, "{linear: 1}", "expected {x: …, y: …, z: …}, got 1"),
        (Twist, "{linear: {x: fast}}", "x is a number, got 'fast'"),
        (JointState, "{name: knee}", "'name' field"),
    ],
)
def test_a_value_that_does_not_fit_is_reported(message_type: Any, text: str, error_text: str) -> None:
    with pytest.raises(CommandError) as error:
        message_from_yaml(message_type, text)
    assert error_text in str(error.value)


def test_a_message_is_printed_field_by_field() -> None:
    joints = JointState(name=["hip"], position=[0.5])
    assert message_to_yaml(joints) == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n"
        "name:\n- hip\nposition:\n- 0.5\nvelocity: []\neffort: []\n"
    )


def test_long_values_are_cut() -> None:
    joints = JointState(name=["shoulder"], position=[1.0, 2.0, 3.0])
    text = message_to_yaml(joints, longest=2)
    assert "name:\n- sh...\n" in text
    assert "position:\n- 1.0\n- 2.0\n- '...'\n" in text
