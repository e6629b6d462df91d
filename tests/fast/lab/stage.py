"""A robot that consists only of its messages, for the tests of recordings."""

from __future__ import annotations

import math
import time
from typing import Any

import pytest
from nav_msgs.msg import Odometry

from humanoid_interfaces.msg import RobotState
from lab.pictures.recording import Recording


class Stage:
    """Sends a recording the messages of a robot, with times since the start of the recording."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 1000.0
        monkeypatch.setattr(time, "monotonic", lambda: self.now)
        monkeypatch.setattr(time, "time", lambda: self.now + 5e8)
        self.recording = Recording()

    def publish(self, topic: str, message: Any, at: float) -> None:
        stamp = 5e8 + 1000.0 + at
        message.header.stamp.sec = int(stamp)
        message.header.stamp.nanosec = int((stamp - int(stamp)) * 1e9)
        self.recording.add_message(topic, message)

    def walk(
        self,
        at: float,
        *,
        speed: float = 0.3,
        height: float = 0.6,
        yaw: float = 0.0,
        pitch: float = 0.0,
        x: float = 0.0,
        y: float = 0.0,
    ) -> None:
        message = Odometry()
        message.pose.pose.position.x, message.pose.pose.position.y = x, y
        message.twist.twist.linear.x = speed
        message.pose.pose.position.z = height
        q = message.pose.pose.orientation
        half, lean = yaw / 2, pitch / 2
        q.w, q.z = math.cos(half) * math.cos(lean), math.sin(half) * math.cos(lean)
        q.x, q.y = -math.sin(half) * math.sin(lean), math.cos(half) * math.sin(lean)
        self.publish("odom", message, at)

    def be(self, mode: int, at: float) -> None:
        self.publish("robot_state", RobotState(mode=mode), at)

    def end(self, at: float) -> Recording:
        self.now = 1000.0 + at
        self.recording.end()
        return self.recording
