"""Topics without subscribers are not computed: hands, objects and feet are read only for subscribers."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
import pytest
from builtin_interfaces.msg import Time

from robot_sim.model.side import SIDES
from robot_sim.ros.foot_topics import FootTopics
from robot_sim.ros.manipulation_topics import ManipulationTopics
from robot_sim.state import HandPose, ObjectPose, Wrench

TOPICS = [
    f"{side.letter}_{topic}" for side in SIDES for topic in ("hand/pose", "gripper/wrench", "foot/wrench")
]
POSITION, QUATERNION = np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0])


class Topic:
    """A publisher that counts what is published."""

    def __init__(self) -> None:
        self.subscribers = self.published = 0

    def get_subscription_count(self) -> int:
        return self.subscribers

    def publish(self, message: Any) -> None:
        self.published += 1


class CountingRobot:
    """Stands for the node and the robot, and counts how often each part of the robot is read."""

    def __init__(self) -> None:
        self.readings: Counter[str] = Counter()
        self.topics: dict[str, Topic] = {}
        self.hands = {side: CountingHand(f"{side.letter}_hand", self.readings) for side in SIDES}
        self.feet = {side: CountingFoot(f"{side.letter}_foot", self.readings) for side in SIDES}
        jobs = (*FootTopics(self, self).jobs, *ManipulationTopics(self, self).jobs)  # type: ignore[arg-type]
        self.readings.clear()
        self._jobs = [job for _, job in jobs]

    def do_all_jobs(self) -> None:
        for job in self._jobs:
            job()

    def object_poses(self) -> dict[str, ObjectPose]:
        self.readings["objects"] += 1
        return {"cup": ObjectPose(POSITION, QUATERNION)}

    def create_publisher(self, message_type: Any, name: str, depth: int) -> Topic:
        return self.topics.setdefault(name, Topic())

    def create_subscription(self, *_: Any) -> None:
        pass

    def get_clock(self) -> CountingRobot:
        return self

    def now(self) -> CountingRobot:
        return self

    def to_msg(self) -> Time:
        return Time()


class CountingHand:
    def __init__(self, name: str, readings: Counter[str]) -> None:
        self._name, self._readings = name, readings

    @property
    def pose(self) -> HandPose:
        self._readings[f"{self._name}/pose"] += 1
        return HandPose(POSITION, QUATERNION)

    @property
    def grip_force(self) -> float:
        self._readings[f"{self._name.replace('hand', 'gripper')}/wrench"] += 1
        return 0.0


class CountingFoot:
    def __init__(self, name: str, readings: Counter[str]) -> None:
        self._name, self._readings = name, readings

    def read(self) -> Wrench:
        self._readings[f"{self._name}/wrench"] += 1
        return Wrench(np.zeros(3), np.zeros(3))


def test_without_subscribers_nothing_is_read_and_nothing_is_published() -> None:
    robot = CountingRobot()
    assert {*TOPICS, "objects/cup/pose"} == set(robot.topics)
    robot.do_all_jobs()
    assert not robot.readings
    assert not any(topic.published for topic in robot.topics.values())


@pytest.mark.parametrize("name", TOPICS)
def test_a_subscriber_makes_its_own_topic_be_read_and_no_other(name: str) -> None:
    robot = CountingRobot()
    robot.topics[name].subscribers = 1
    robot.do_all_jobs()
    assert robot.readings == {name: 1}
    assert {topic for topic, made in robot.topics.items() if made.published} == {name}


def test_a_subscriber_of_an_object_makes_the_objects_be_read_once() -> None:
    robot = CountingRobot()
    robot.topics["objects/cup/pose"].subscribers = 1
    robot.do_all_jobs()
    assert robot.readings == {"objects": 1}
