"""The events that the simulator writes about the robot and itself, to a pipe that student code cannot reach."""

from __future__ import annotations

from typing import Any

from ros_runtime.record.event import Event


class RobotReady(Event):
    """The robot stands and its topics exist.

    `fastest` is how fast it can walk, `still` how fast its pelvis may move a second after its stop, m/s.
    """

    fastest: float = 0.4
    still: float = 0.05


class RobotTruth(Event):
    """The simulator's state of the robot (50 Hz): base_link in odom (m, rad), speed over ground (m/s).

    `up` is 1 when upright; `mode` is a constant of humanoid_interfaces/RobotState; `battery` is 0..1; `lag` is how far
    (s) the simulation was behind the clock.
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


class BodyDescribed(Event):
    """The names of the joints and objects in PostureTruth, in the order of its lists; only in recorded runs.

    `scene` and `robot` are a scene and a robot of robot_sim.
    """

    scene: str
    joints: list[str]
    objects: list[str]
    robot: str = "humanoid"


class PostureTruth(Event):
    """The whole posture of the robot (25 Hz); only in recorded runs, for films. Checks have no access to it.

    `base` (base_link) and each of `objects`: position (m) and quaternion (x, y, z, w) in odom. `twist`: linear m/s and
    angular rad/s, in base_link. `positions`, `velocities`: of the joints, rad and rad/s (fingers: m and m/s).
    """

    base: list[float]
    twist: list[float]
    positions: list[float]
    velocities: list[float]
    objects: list[list[float]]


class BatteryPublished(Event):
    """The robot published `message` on battery_state: a sensor_msgs/BatteryState."""

    message: Any


class JointsPublished(Event):
    """The robot published a message on joint_states: a position for each name, rad (fingers: m)."""

    names: list[str]
    positions: list[float]


class ImuPublished(Event):
    """The robot published this on imu. Also the gyro's true bias: rad/s about x, y and z of imu_link."""

    angular_velocity: list[float]
    gyro_bias: list[float]


class JointsTruth(Event):
    """True positions and velocities of the joints that a scenario has requested (50 Hz), rad and rad/s."""

    positions: dict[str, float]
    velocities: dict[str, float]


class FeetTruth(Event):
    """True load on each foot, N, if a scenario has requested it (50 Hz)."""

    left: float
    right: float


class HandTruth(Event):
    """State of a hand that a scenario has requested (50 Hz): the point between its pads, m in odom.

    `opening` is the distance between the pads, m; `forces` are their contact forces, N.
    """

    side: str
    position: list[float]
    opening: float
    forces: list[float]


class ObjectTruth(Event):
    """State of an object that a scenario has requested (50 Hz): its centre, m in odom.

    `up` is 1 when it is upright; `speed` is m/s.
    """

    name: str
    position: list[float]
    up: float
    speed: float


class ArmReported(Event):
    """Positions of an arm's elbow and hand (between the fingers): m from its shoulder, along the torso's x, y and z."""

    side: str
    elbow: list[float]
    hand: list[float]


class RobotPeers(Event):
    """How many subscribers and publishers of other nodes the robot is connected to, by topic."""

    subscribers: dict[str, int]
    publishers: dict[str, int]


class RobotCommanded(Event):
    """A command of the scenario took effect in the simulator."""

    command: dict[str, Any]

    @property
    def verb(self) -> str:
        """The command's name in words: 'set battery'."""
        return str(self.command.get("do", "")).replace("_", " ")


class MotorPowerReceived(Event):
    """The robot received a message on motor_power; in a flood only the first ones are recorded."""

    on: bool


class RobotRefused(Event):
    """The robot refused messages of a topic: `count` so far, the `bytes` of the largest, and the `limit` for each."""

    topic: str
    count: int
    bytes: int
    limit: int
    reason: str
