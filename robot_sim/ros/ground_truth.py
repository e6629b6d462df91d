"""The ground truth of a graded robot, written to a pipe that student code cannot reach and so cannot forge."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence

import numpy as np
from sensor_msgs.msg import BatteryState

from robot_sim.humanoid import Humanoid
from robot_sim.model.side import Side
from robot_sim.ros.posture import PostureReader
from ros_runtime.record.event import Event, to_line
from ros_runtime.record.ground_truth import (
    ArmReported,
    BatteryPublished,
    FeetTruth,
    HandTruth,
    ImuPublished,
    JointsPublished,
    JointsTruth,
    MotorPowerReceived,
    ObjectTruth,
    RobotCommanded,
    RobotPeers,
    RobotReady,
    RobotRefused,
    RobotTruth,
)

GROUND_TRUTH_RATE = 50.0  # Hz, simulated
STATES_A_POSTURE = 2  # one posture per two states of the robot, if requested: 25 Hz
MOST_POSTURES = 5000  # 200 s, longer than any scenario
MOST_POWER_MESSAGES = 100  # motor_power messages to write; the rest of a flood adds no information
DIGITS = 4  # decimals for joints, hands and objects (0.1 mrad or mm), to keep records small


class GroundTruthWriter:
    """A writer of JSON objects, one on each line; `t` is `time.monotonic()` of the writing process, s."""

    def __init__(self, fd: int) -> None:
        self._fd = fd
        self._power_messages = 0
        self._reported_joints: dict[str, tuple[int, int]] = {}
        self._feet_are_reported = False
        self._reported_hands: list[Side] = []
        self._reported_objects: list[str] = []
        self._posture: PostureReader | None = None
        self._states = 0

    def ready(self) -> None:
        """Write that the robot stands and its topics exist."""
        self._write(RobotReady())

    def robot(self, humanoid: Humanoid, lag: float) -> None:
        """Write the robot's state, and the greatest lag (s) of the simulation behind the clock since the last call."""
        pose, velocity = humanoid.base_pose(), humanoid.base_velocity()
        x, y, z = pose.position.tolist()
        vx, vy, _ = velocity.linear.tolist()
        self._write(
            RobotTruth(
                simulated=humanoid.time,
                lag=lag,
                x=x,
                y=y,
                z=z,
                yaw=float(pose.yaw),
                speed=math.hypot(vx, vy),
                turn_rate=float(velocity.angular[2]),
                up=float(humanoid.up()),
                mode=int(humanoid.mode),
                motors_enabled=bool(humanoid.motors_enabled),
                steps=int(humanoid.steps),
                battery=float(humanoid.battery.percentage),
            )
        )
        if self._posture and self._states < STATES_A_POSTURE * MOST_POSTURES:
            if self._states % STATES_A_POSTURE == 0:
                self._write(self._posture.read())
            self._states += 1
        if self._reported_joints:
            self._joints(humanoid)
        if self._feet_are_reported:
            self._feet(humanoid)
        for side in self._reported_hands:
            self._hand(humanoid, side)
        for name in self._reported_objects:
            self._object(humanoid, name)

    def report_postures(self, humanoid: Humanoid) -> None:
        """Write the whole posture with every second state of the robot from now on, for a recording."""
        self._posture = PostureReader(humanoid)
        self._write(self._posture.description)

    def report_joints(self, humanoid: Humanoid, names: Sequence[str]) -> None:
        """Write positions and velocities of these joints, now and with each state of the robot from now on."""
        joints = [humanoid.model.joint(name) for name in names]
        self._reported_joints = {
            joint.name: (int(joint.qposadr[0]), int(joint.dofadr[0])) for joint in joints
        }
        self._joints(humanoid)

    def _joints(self, humanoid: Humanoid) -> None:
        places, rates = humanoid.data.qpos, humanoid.data.qvel
        self._write(
            JointsTruth(
                positions={
                    name: round(float(places[at]), DIGITS) for name, (at, _) in self._reported_joints.items()
                },
                velocities={
                    name: round(float(rates[at]), DIGITS) for name, (_, at) in self._reported_joints.items()
                },
            )
        )

    def report_feet(self, humanoid: Humanoid) -> None:
        """Write the load on each foot, now and with each state of the robot from now on."""
        self._feet_are_reported = True
        self._feet(humanoid)

    def _feet(self, humanoid: Humanoid) -> None:
        left, right = (float(humanoid.feet[side].read().force[2]) for side in (Side.LEFT, Side.RIGHT))
        self._write(FeetTruth(left=left, right=right))

    def report_hand(self, humanoid: Humanoid, side: Side) -> None:
        """Write position, opening and contact forces of a hand, now and with each state of the robot from now on."""
        self._reported_hands.append(side)
        self._hand(humanoid, side)

    def _hand(self, humanoid: Humanoid, side: Side) -> None:
        hand = humanoid.hands[side]
        self._write(
            HandTruth(
                side=side.letter,
                position=_rounded(hand.pose.position),
                opening=round(hand.opening, DIGITS),
                forces=_rounded(hand.forces),
            )
        )

    def report_object(self, humanoid: Humanoid, name: str) -> None:
        """Write where an object is, now and with each state of the robot from now on."""
        self._reported_objects.append(name)
        self._object(humanoid, name)

    def _object(self, humanoid: Humanoid, name: str) -> None:
        body = humanoid.data.body(name)
        velocity = humanoid.data.joint(name).qvel[:3]
        self._write(
            ObjectTruth(
                name=name,
                position=_rounded(body.xpos),
                up=round(float(body.xmat[8]), DIGITS),
                speed=round(float(np.linalg.norm(velocity)), DIGITS),
            )
        )

    def battery_published(self, message: BatteryState) -> None:
        """Write a message that was published on battery_state."""
        self._write(BatteryPublished(message=message))

    def joints_published(self, names: Sequence[str], positions: Sequence[float]) -> None:
        """Write the content of a message on joint_states: a position for each name, rad (fingers: m)."""
        self._write(JointsPublished(names=list(names), positions=list(positions)))

    def imu_published(self, angular_velocity: Sequence[float], gyro_bias: Sequence[float]) -> None:
        """Write the angular velocity of a message on imu, and the gyro's true bias: rad/s about x, y, z of imu_link."""
        self._write(ImuPublished(angular_velocity=list(angular_velocity), gyro_bias=list(gyro_bias)))

    def arm(self, humanoid: Humanoid, side: Side) -> None:
        """Write the positions of an arm's elbow and hand: m from its shoulder, along the torso's x, y and z."""
        data = humanoid.data
        shoulder = data.body(f"{side.letter}_shoulder_pitch_link").xpos
        axes = data.body("torso").xmat.reshape(3, 3)
        elbow = (data.body(f"{side.letter}_forearm").xpos - shoulder) @ axes
        hand = (data.site(f"{side.letter}_grip").xpos - shoulder) @ axes
        self._write(ArmReported(side=side.letter, elbow=elbow.tolist(), hand=hand.tolist()))

    def peers(self, subscribers: dict[str, int], publishers: dict[str, int]) -> None:
        """Write how many subscribers and publishers of other nodes the robot is connected to, by topic."""
        self._write(RobotPeers(subscribers=subscribers, publishers=publishers))

    def motor_power(self, on: bool) -> None:
        """Write a message that was received on motor_power."""
        self._power_messages += 1
        if self._power_messages <= MOST_POWER_MESSAGES:
            self._write(MotorPowerReceived(on=on))

    def refused(self, topic: str, count: int, largest: int, limit: int, reason: str) -> None:
        """Write how many messages of a topic were refused, the bytes of the largest, the limit, and the reason."""
        self._write(RobotRefused(topic=topic, count=count, bytes=largest, limit=limit, reason=reason))

    def commanded(self, command: dict) -> None:
        """Write a command of the scenario when it takes effect."""
        self._write(RobotCommanded(command=command))

    def _write(self, event: Event) -> None:
        view = memoryview(to_line(event))
        while view:
            view = view[os.write(self._fd, view) :]


def _rounded(numbers: Iterable[float]) -> list[float]:
    return [round(float(number), DIGITS) for number in numbers]
