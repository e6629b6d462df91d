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
    stored = SimpleNamespace(messages={}, age=lambda topic: math.inf)
    monkeypatch.setattr(topics, "_last_messages", lambda: stored)
    monkeypatch.setattr(topics, "robot_of_another_notebook", lambda: LabRobot(5, 1000, "02_services.ipynb"))
    began = time.monotonic()
    with pytest.raises(NoRobotError, match=r"ended when 02_services.ipynb started one"):
        topics.pose()
    assert time.monotonic() - began < 1.0
