"""What a notebook says when no message of its robot arrives."""

from __future__ import annotations

import math
import time
from types import SimpleNamespace

import pytest

from lab.client import topics
from lab.errors import NoRobotError
from ros_runtime.notebook_domains import LabRobot


def test_a_robot_that_another_notebook_has_taken_is_reported_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    stored = SimpleNamespace(messages={}, age=lambda topic: math.inf, was_stopped=False)
    monkeypatch.setattr(topics, "_last_messages", lambda: stored)
    monkeypatch.setattr(topics, "robot_of_another_notebook", lambda: LabRobot(5, 1000, "02_services.ipynb"))
    began = time.monotonic()
    with pytest.raises(NoRobotError, match=r"ended when 02_services.ipynb started one"):
        topics.pose()
    assert time.monotonic() - began < 1.0


@pytest.mark.parametrize(
    ("was_stopped", "message"),
    [(True, "the robot was stopped"), (False, "no message arrived on /robot/odom for 0.1 s; does the robot")],
)
def test_without_a_robot_the_error_says_what_to_do(
    monkeypatch: pytest.MonkeyPatch, was_stopped: bool, message: str
) -> None:
    stored = SimpleNamespace(messages={}, age=lambda topic: math.inf, was_stopped=was_stopped)
    monkeypatch.setattr(topics, "_last_messages", lambda: stored)
    with pytest.raises(NoRobotError, match=rf"{message}.*lab.start_robot\(\)"):
        topics.latest("odom", timeout=0.1)
