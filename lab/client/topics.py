"""The last message on each of the robot's topics, and on those of the objects around it."""

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
from lab.client.waiting import comes_true
from lab.errors import NoRobotError
from robot_sim.model.scenes import OBJECTS
from ros_runtime.angles import yaw_of
from ros_runtime.message_constants import RobotMode, name_of

QUEUE = 100  # messages: five seconds of odom, so that a busy notebook loses none
LATCHED = QoSProfile(depth=QUEUE, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=QUEUE, reliability=ReliabilityPolicy.BEST_EFFORT)
TOPICS: dict[str, tuple[Any, Any]] = {
    "robot_state": (RobotState, LATCHED),
    "battery_state": (BatteryState, LATCHED),
    "odom": (Odometry, QUEUE),
    "joint_states": (JointState, BEST_EFFORT),
}
GRIP = "r_gripper/wrench"  # subscribed to only in scenes with objects
FRESH = 1.0  # s; each of these topics has at least twice this rate


class Pose(NamedTuple):
    """Where base_link is, in frame odom: metres and radians."""

    x: float
    y: float
    yaw: float

    def __repr__(self) -> str:
        return f"x {fixed(self.x, 2)} m, y {fixed(self.y, 2)} m, heading {fixed(math.degrees(self.yaw), 0)}°"


def robot_state() -> RobotState:
    """The last message on robot_state."""
    return latest("robot_state")


def battery() -> BatteryState:
    """The last message on battery_state."""
    return latest("battery_state")


def odometry() -> Odometry:
    """The last message on odom: pose of base_link in frame odom, velocity in base_link."""
    return latest("odom")


def pose() -> Pose:
    """Position x, y (m) and heading (rad) from the last message on odom."""
    where = odometry().pose.pose
    q = where.orientation
    yaw = yaw_of(q.x, q.y, q.z, q.w)
    return Pose(where.position.x, where.position.y, yaw)


def mode() -> str:
    """The robot's mode by its name in RobotState: "OFF", "STANDING", "WALKING" or "FALLEN"."""
    return name_of(RobotMode, robot_state().mode)


def latest(topic: str, timeout: float = 5.0) -> Any:
    """The last message on one of the robot's topics; waits for a new one if the last is older than a second.

    Raises NoRobotError when none comes within `timeout` s.
    """
    memory = _memory()
    if not comes_true(lambda: memory.age(topic) <= FRESH, timeout):
        raise NoRobotError(
            f"nothing arrived on {NAMESPACE}/{topic} for {timeout:g} s; is the robot up? Try lab.start_robot()"
        )
    return memory.messages[topic][0]


def has_published() -> bool:
    """Whether a message was received on every topic of the robot since `enter()`."""
    return _memory().messages.keys() >= TOPICS.keys()


def enter(scene: str) -> None:
    """Forget an earlier robot; listen also to the objects of this scene and to the hand that takes them."""
    memory = _memory()
    memory.messages.clear()
    memory.scene = scene
    if OBJECTS[scene]:
        memory.listen_to(GRIP, WrenchStamped, QUEUE)
    for name in OBJECTS[scene]:
        memory.listen_to(topic_of(name), PoseStamped, QUEUE)


def scene() -> str:
    """Name of the scene that the robot was started in."""
    return _memory().scene


def object_poses() -> dict[str, PoseStamped]:
    """The last pose of each object of the scene that has published one."""
    memory = _memory()
    return {
        name: memory.messages[topic_of(name)][0]
        for name in OBJECTS[memory.scene]
        if topic_of(name) in memory.messages
    }


def topic_of(name: str) -> str:
    """The topic of an object's pose."""
    return f"objects/{name}/pose"


@contextmanager
def listening(listener: Callable[[str, Any], object]) -> Iterator[None]:
    """Call `listener(topic, message)` for each message, on a thread of the lab, as long as the `with` block lasts."""
    listeners = _memory().listeners
    listeners.append(listener)
    try:
        yield
    finally:
        listeners.remove(listener)


def _memory() -> _Memory:
    return connection().once("last messages", _Memory)


class _Memory:
    """Subscribes to the robot's topics and keeps each topic's last message with its time of arrival.

    `scene`: name of the scene that the robot was started in.
    """

    def __init__(self, node: Node) -> None:
        self.messages: dict[str, tuple[Any, float]] = {}
        self.listeners: list[Callable[[str, Any], object]] = []
        self.scene = "flat"
        self._node = node
        self._topics: set[str] = set()
        for topic, (message_type, qos) in TOPICS.items():
            self.listen_to(topic, message_type, qos)

    def listen_to(self, topic: str, message_type: Any, qos: Any) -> None:
        """Subscribe to a topic, once."""
        if topic not in self._topics:
            self._topics.add(topic)
            self._node.create_subscription(message_type, topic, partial(self._keep, topic), qos)

    def age(self, topic: str) -> float:
        """Seconds since the last message on a topic arrived."""
        kept = self.messages.get(topic)
        return math.inf if kept is None else time.monotonic() - kept[1]

    def _keep(self, topic: str, message: Any) -> None:
        before = self.messages.get(topic)
        self.messages[topic] = (message, time.monotonic())
        if topic == "robot_state" and before and before[0].mode != message.mode:
            log.append(ModeChanged(mode=message.mode))
        for listener in tuple(self.listeners):
            listener(topic, message)
