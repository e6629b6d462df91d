"""The simulator's events about the robot and itself, by a pipe that student code cannot reach."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ros_runtime.record.event import Event


@dataclass(frozen=True, kw_only=True)
class RobotReady(Event):
    """The robot stands and its topics exist."""


@dataclass(frozen=True, kw_only=True)
class RobotTruth(Event):
    """The simulator's state of the robot (50 Hz): base_link in odom (m, rad), speed over ground (m/s).

    `up` is 1 when upright; `mode` is of humanoid_interfaces/RobotState; `battery` is 0..1; `lag` is how far (s) the
    simulation was behind the clock.
    """

    simulated: float
    lag: float
    x: float
    y: float
    z: float
    yaw: float
    speed: float
    turn_rate: float
    up: float
    mode: int
    motors_enabled: bool
    steps: int
    battery: float


@dataclass(frozen=True, kw_only=True)
class BodyDescribed(Event):
    """What the postures of this robot are made of, where a recording is asked for.

    `scene` is robot_sim's; `joints` and `objects` name what a PostureTruth places, in its order.
    """

    scene: str
    joints: list[str]
    objects: list[str]


@dataclass(frozen=True, kw_only=True)
class PostureTruth(Event):
    """Where every part of the robot is (25 Hz), where a recording is asked for: it is for films, no check sees it.

    `base` is base_link in odom, as each of `objects` is: position (m) and quaternion (x, y, z, w); `twist` is in
    base_link, linear m/s and angular rad/s; `positions` and `velocities` are of the joints, rad (fingers: m).
    """

    base: list[float]
    twist: list[float]
    positions: list[float]
    velocities: list[float]
    objects: list[list[float]]


@dataclass(frozen=True, kw_only=True)
class BatteryPublished(Event):
    """What the robot published on battery_state: a sensor_msgs/BatteryState."""

    message: Any


@dataclass(frozen=True, kw_only=True)
class JointsPublished(Event):
    """What the robot published on joint_states: a position for each name, rad (fingers: m)."""

    names: list[str]
    positions: list[float]


@dataclass(frozen=True, kw_only=True)
class ImuPublished(Event):
    """What the robot published on imu, and the gyro's true bias: rad/s about x, y and z of imu_link."""

    angular_velocity: list[float]
    gyro_bias: list[float]


@dataclass(frozen=True, kw_only=True)
class JointsTruth(Event):
    """Where the joints are that a scenario asked about (50 Hz), rad and rad/s; whoever reads joint_states."""

    positions: dict[str, float]
    velocities: dict[str, float]


@dataclass(frozen=True, kw_only=True)
class FeetTruth(Event):
    """What each foot carries, N, where a scenario asked about it (50 Hz); whoever reads their topics."""

    left: float
    right: float


@dataclass(frozen=True, kw_only=True)
class HandTruth(Event):
    """Where the point between the pads of a hand is that a scenario asked about (50 Hz), m in odom.

    `opening` is the distance of the pads, m; `forces` is the contact force of each, N.
    """

    side: str
    position: list[float]
    opening: float
    forces: list[float]


@dataclass(frozen=True, kw_only=True)
class ObjectTruth(Event):
    """Where the centre of an object is that a scenario asked about (50 Hz), m in odom.

    `up` is 1 when it is upright; `speed` is m/s.
    """

    name: str
    position: list[float]
    up: float
    speed: float


@dataclass(frozen=True, kw_only=True)
class ArmReported(Event):
    """Where elbow and hand (between the fingers) of an arm were: m from its shoulder, along the torso's x, y and z."""

    side: str
    elbow: list[float]
    hand: list[float]


@dataclass(frozen=True, kw_only=True)
class RobotPeers(Event):
    """How many subscribers and publishers of other nodes the robot is connected to, by topic."""

    subscribers: dict[str, int]
    publishers: dict[str, int]


@dataclass(frozen=True, kw_only=True)
class RobotCommanded(Event):
    """A command of the scenario took effect in the simulator."""

    command: dict[str, Any]

    @property
    def verb(self) -> str:
        """What the robot was told to do, in words: 'set battery'."""
        return str(self.command.get("do", "")).replace("_", " ")


@dataclass(frozen=True, kw_only=True)
class MotorPowerReceived(Event):
    """A message on motor_power reached the robot; of many only the first are written."""

    on: bool


@dataclass(frozen=True, kw_only=True)
class RobotRefused(Event):
    """How many messages of a topic the robot refused so far, the largest one's bytes, how many it may have, and why."""

    topic: str
    count: int
    bytes: int
    limit: int
    reason: str
