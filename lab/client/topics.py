"""Subscribes to the topics of the robot and of the objects around it, and keeps the last message of each."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any, NamedTuple

from geometry_msgs.msg import PoseStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import BatteryState, JointState

from humanoid_interfaces.msg import RobotState
from lab.client.connection import NAMESPACE, connection
from lab.client.formatting import fixed
from lab.client.interaction_log import log
from lab.client.messages import ModeChanged
from lab.client.waiting import becomes_true
from lab.errors import NoRobotError
from robot_sim.model.scenes import OBJECTS
from ros_runtime.angles import yaw_of
from ros_runtime.cell_notice import notice
from ros_runtime.message_constants import RobotMode, name_of
from ros_runtime.notebook_domains import robot_of_another_notebook

QUEUE_DEPTH = 100  # messages, which are five seconds of odom: a busy notebook loses none
LATCHED = QoSProfile(depth=QUEUE_DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=QUEUE_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
TOPICS: dict[str, tuple[Any, Any]] = {
    "robot_state": (RobotState, LATCHED),
    "battery_state": (BatteryState, LATCHED),
    "odom": (Odometry, QUEUE_DEPTH),
    "joint_states": (JointState, BEST_EFFORT),
}
GRIPPER_TOPIC = "r_gripper/wrench"  # subscribed to only in scenes with objects
START_TIMEOUT = 30.0  # s, from the start of the robot to its first messages
MAX_AGE = 1.0  # s of a message that still counts as current; each topic is published at least twice a second


class Pose(NamedTuple):
    """The position (m) and heading (rad) of base_link in frame odom."""

    x: float
    y: float
    yaw: float

    def __repr__(self) -> str:
        return f"x {fixed(self.x, 2)} m, y {fixed(self.y, 2)} m, heading {fixed(math.degrees(self.yaw), 0)}°"


def robot_state() -> RobotState:
    """Return the last message on robot_state."""
    return latest("robot_state")


def battery() -> BatteryState:
    """Return the last message on battery_state."""
    return latest("battery_state")


def odometry() -> Odometry:
    """Return the last message on odom: the pose of base_link in frame odom, and its velocity in base_link."""
    return latest("odom")


def pose() -> Pose:
    """Return the position x, y (m) and the heading (rad) from the last message on odom."""
    where = odometry().pose.pose
    q = where.orientation
    yaw = yaw_of(q.x, q.y, q.z, q.w)
    return Pose(where.position.x, where.position.y, yaw)


def mode() -> str:
    """Return the robot's mode by its name in RobotState: "OFF", "STANDING", "WALKING" or "FALLEN"."""
    return name_of(RobotMode, robot_state().mode)


def whereabouts() -> str:
    """Return the robot's mode and pose in words; a robot that lies has no heading that says anything."""
    words = f"{mode()} at {pose()}"
    return words.partition(", heading")[0] if mode() == "FALLEN" else words


def fell_at() -> float | None:
    """Return when the robot fell, in s of `time.monotonic()`; None if no robot runs that lies."""
    stored = _last_messages()
    lies = stored.age("robot_state") <= MAX_AGE and mode() == "FALLEN"
    return stored.mode_changed_at if lies else None


def taken_robot() -> str:
    """Return a sentence if another notebook's robot has replaced that of this notebook, and what to do; else ""."""
    if (other := robot_of_another_notebook()) and _last_messages().age("robot_state") > MAX_AGE:
        return (
            f"the robot of this notebook ended when {other.notebook} started one: you have one robot at a time. "
            "lab.start_robot() brings it back"
        )
    return ""


def forget_messages() -> None:
    """Drop the messages of a robot that was stopped."""
    stored = _last_messages()
    stored.messages.clear()
    stored.reset_at, stored.was_stopped = -math.inf, True


def latest(topic: str, timeout: float = 5.0) -> Any:
    """Return the last message on one of the robot's topics; if it is older than a second, wait for a new one.

    Raises NoRobotError when no message arrives within `timeout` s; at once if this notebook has stopped the robot, or
    another one has taken it.
    """
    stored = _last_messages()

    def is_current() -> bool:
        return stored.age(topic) <= MAX_AGE

    if is_current():
        return stored.messages[topic][0]
    if taken := taken_robot():
        raise NoRobotError(taken)
    if stored.was_stopped:
        raise NoRobotError("the robot was stopped: lab.start_robot() starts one")
    waits = f"No message arrives on {NAMESPACE}/{topic}: this waits up to {timeout:g} s for a robot that publishes it."
    with notice(waits):
        arrives = becomes_true(is_current, timeout)
    if not arrives:
        raise NoRobotError(
            f"no message arrived on {NAMESPACE}/{topic} for {timeout:g} s; does the robot run? Try lab.start_robot()"
        )
    return stored.messages[topic][0]


def has_published() -> bool:
    """Whether a message was received on every topic of the robot since `reset_for_scene()`."""
    return _last_messages().messages.keys() >= TOPICS.keys()


def is_starting() -> bool:
    """Whether a robot was started so lately that its first messages may still be on their way."""
    return not has_published() and time.monotonic() < _last_messages().reset_at + START_TIMEOUT


def reset_for_scene(scene: str, robot: str = "humanoid") -> None:
    """Drop the messages of an earlier robot, and subscribe to the objects of this scene and to the right gripper."""
    stored = _last_messages()
    stored.messages.clear()
    stored.reset_at, stored.was_stopped = time.monotonic(), False
    stored.scene, stored.robot = scene, robot
    if OBJECTS[scene]:
        stored.subscribe(GRIPPER_TOPIC, WrenchStamped, QUEUE_DEPTH)
    for name in OBJECTS[scene]:
        stored.subscribe(topic_of(name), PoseStamped, QUEUE_DEPTH)


def scene() -> str:
    """Return the name of the scene in which the robot was started."""
    return _last_messages().scene


def robot() -> str:
    """Return the name of the robot that was started: "humanoid" or "g1"."""
    return _last_messages().robot


def object_poses() -> dict[str, PoseStamped]:
    """Return the last pose of each object of the scene whose pose has arrived."""
    stored = _last_messages()
    return {
        name: stored.messages[topic_of(name)][0]
        for name in OBJECTS[stored.scene]
        if topic_of(name) in stored.messages
    }


def topic_of(name: str) -> str:
    """Return the topic of an object's pose."""
    return f"objects/{name}/pose"


@contextmanager
def listening(listener: Callable[[str, Any], object]) -> Iterator[None]:
    """While the `with` block runs, call `listener(topic, message)` for each message, on a thread of the lab."""
    listeners = _last_messages().listeners
    listeners.append(listener)
    try:
        yield
    finally:
        listeners.remove(listener)


def _last_messages() -> _LastMessages:
    return connection().get_or_create("last messages", _LastMessages)


class _LastMessages:
    """Subscribes to topics and keeps each topic's last message with its time of arrival.

    `scene` is the name of the scene in which the robot was started, `robot` the robot's name, `was_stopped` whether
    `stop_robot()` ended it; `mode_changed_at` and `reset_at`, just before the start, are in s of `time.monotonic()`.
    """

    def __init__(self, node: Node) -> None:
        self.messages: dict[str, tuple[Any, float]] = {}
        self.listeners: list[Callable[[str, Any], object]] = []
        self.scene, self.robot = "flat", "humanoid"
        self.mode_changed_at = time.monotonic()
        self.reset_at = -math.inf
        self.was_stopped = False
        self._node = node
        self._topics: set[str] = set()
        for topic, (message_type, qos) in TOPICS.items():
            self.subscribe(topic, message_type, qos)

    def subscribe(self, topic: str, message_type: Any, qos: Any) -> None:
        """Subscribe to a topic, unless that was done before."""
        if topic not in self._topics:
            self._topics.add(topic)
            self._node.create_subscription(message_type, topic, partial(self._store, topic), qos)

    def age(self, topic: str) -> float:
        """Return how long ago the last message on a topic arrived, in s; infinity if none has arrived."""
        kept = self.messages.get(topic)
        return math.inf if kept is None else time.monotonic() - kept[1]

    def _store(self, topic: str, message: Any) -> None:
        before = self.messages.get(topic)
        self.messages[topic] = (message, time.monotonic())
        if topic == "robot_state" and before and before[0].mode != message.mode:
            self.mode_changed_at = time.monotonic()
            log.append(ModeChanged(mode=message.mode))
        for listener in tuple(self.listeners):
            listener(topic, message)
