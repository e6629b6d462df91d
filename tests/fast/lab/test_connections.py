"""A wait that fails names what keeps the student's node and the robot apart, in the words of the self-check."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data

from lab.client.graph import Endpoint, Topic
from lab.running import node_diagnosis
from lab.running.node_diagnosis import why_not_connected

PROGRAM = """
from sensor_msgs.msg import BatteryState, Imu
from std_msgs.msg import Bool
"""
BATTERY, IMU, BOOL = "sensor_msgs/msg/BatteryState", "sensor_msgs/msg/Imu", "std_msgs/msg/Bool"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PLAIN = QoSProfile(depth=10)
OFFERED = {
    "battery_state": (BATTERY, LATCHED),
    "imu": (IMU, qos_profile_sensor_data),
    "odom": ("nav_msgs/msg/Odometry", PLAIN),
}
RIGHT = {"/robot/battery_state": (BATTERY, LATCHED), "/robot/imu": (IMU, qos_profile_sensor_data)}
POWER = {"/robot/motor_power": (BOOL, PLAIN)}

Ends = dict[str, tuple[str, QoSProfile]]


def graph_of(subscribes: Ends, publishes: Ends) -> list[Topic]:
    """The topics of the robot and of a node `/robot/mine`."""
    from_robot = {f"/robot/{name}": each for name, each in OFFERED.items()}
    publishers = [("/robot/humanoid", from_robot), ("/robot/mine", publishes)]
    subscriptions = [("/robot/humanoid", POWER), ("/robot/mine", subscribes), ("/robot/notebook", from_robot)]

    def ends(sides: list[tuple[str, Ends]], name: str) -> tuple[Endpoint, ...]:
        return tuple(Endpoint(node, *each[name]) for node, each in sides if name in each)

    names = sorted({name for _, each in (*publishers, *subscriptions) for name in each})
    return [
        Topic(name, "of one of its ends", ends(publishers, name), ends(subscriptions, name)) for name in names
    ]


@pytest.mark.parametrize(
    ("subscribes", "publishes", "expected"),
    [
        (RIGHT, POWER, ""),
        ({}, POWER, "Your node does not subscribe to battery_state.\n"),
        (
            RIGHT | {"/robot/battery_state": (IMU, LATCHED)},
            POWER,
            "You subscribe to battery_state, but your subscription does not match the robot's publisher: compare",
        ),
        (
            RIGHT | {"/robot/imu": (IMU, PLAIN)},
            POWER,
            "You subscribe to imu, but your subscription does not match",
        ),
        (
            {"/battery_state": (BATTERY, LATCHED), "/robot/imu": RIGHT["/robot/imu"]},
            POWER,
            "You subscribe to /battery_state, which the robot does not publish: remove the leading slash",
        ),
        (
            {"/robot/battery": (BATTERY, LATCHED), "/robot/imu": RIGHT["/robot/imu"]},
            POWER,
            "Your node does not subscribe to battery_state, but to /robot/battery, /robot/imu.",
        ),
        (RIGHT, {}, "On motor_power the robot sees no publisher: create_publisher in the constructor."),
        (
            RIGHT,
            {"/motor_power": (BOOL, PLAIN)},
            "On motor_power the robot sees a publisher on /motor_power: remove the leading slash",
        ),
        (RIGHT | {"/robot/motor_power": (BOOL, PLAIN)}, POWER, ""),
    ],
)
def test_the_missing_connection_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, subscribes: Ends, publishes: Ends, expected: str
) -> None:
    file = tmp_path / "mine.py"
    file.write_text(PROGRAM, encoding="utf-8")
    monkeypatch.setattr(node_diagnosis, "topics_in_graph", lambda: graph_of(subscribes, publishes))
    said = why_not_connected([SimpleNamespace(file=file, names=["/robot/mine"], is_running=True)])
    if expected:
        assert f"mine.py: {expected}" in said
    else:
        assert said == ""
