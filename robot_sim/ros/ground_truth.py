"""The ground truth of a graded robot, written to a pipe that student code cannot reach and so cannot forge."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from robot_sim.humanoid import Humanoid
from robot_sim.model.side import Side
from robot_sim.ros.posture import PostureReader
from ros_runtime.record.event import Event, to_line
from ros_runtime.record.ground_truth import (
    ArmReported,
    FeetTruth,
    HandTruth,
    JointsTruth,
    MotorPowerReceived,
    ObjectTruth,
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
        self._reports: dict[str, Callable[[], Event]] = {}
        self._posture: PostureReader | None = None
        self._states = 0

    def write(self, event: Event) -> None:
        """Write an event."""
        view = memoryview(to_line(event))
        while view:
            view = view[os.write(self._fd, view) :]

    def robot(self, humanoid: Humanoid, lag: float) -> None:
        """Write the robot's state, and the greatest lag (s) of the simulation behind the clock since the last call."""
        pose, velocity = humanoid.base_pose(), humanoid.base_velocity()
        x, y, z = pose.position.tolist()
        vx, vy, _ = velocity.linear.tolist()
        self.write(
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
                self.write(self._posture.read())
            self._states += 1
        for read in self._reports.values():
            self.write(read())

    def report(self, what: str, read: Callable[[], Event]) -> None:
        """Write the event that `read` returns, now and with each state of the robot; it replaces an earlier `what`."""
        self._reports[what] = read
        self.write(read())

    def report_postures(self, humanoid: Humanoid) -> None:
        """Write the whole posture with every second state of the robot from now on, for a recording."""
        self._posture = PostureReader(humanoid)
        self.write(self._posture.description)

    def motor_power(self, on: bool) -> None:
        """Write a message that was received on motor_power."""
        self._power_messages += 1
        if self._power_messages <= MOST_POWER_MESSAGES:
            self.write(MotorPowerReceived(on=on))


def joints_reader(humanoid: Humanoid, names: Sequence[str]) -> Callable[[], JointsTruth]:
    """Return a function that reads the positions and velocities of these joints."""
    joints = {name: humanoid.data.joint(name) for name in names}

    def read() -> JointsTruth:
        return JointsTruth(
            positions={name: round(float(joint.qpos[0]), DIGITS) for name, joint in joints.items()},
            velocities={name: round(float(joint.qvel[0]), DIGITS) for name, joint in joints.items()},
        )

    return read


def feet_truth(humanoid: Humanoid) -> FeetTruth:
    """Return the load on each foot."""
    left, right = (float(humanoid.feet[side].read().force[2]) for side in (Side.LEFT, Side.RIGHT))
    return FeetTruth(left=left, right=right)


def hand_truth(humanoid: Humanoid, side: Side) -> HandTruth:
    """Return the position, opening and contact forces of a hand."""
    hand = humanoid.hands[side]
    return HandTruth(
        side=side.letter,
        position=_rounded(hand.pose.position),
        opening=round(hand.opening, DIGITS),
        forces=_rounded(hand.forces),
    )


def object_truth(humanoid: Humanoid, name: str) -> ObjectTruth:
    """Return where an object is, and how it moves."""
    body = humanoid.data.body(name)
    velocity = humanoid.data.joint(name).qvel[:3]
    return ObjectTruth(
        name=name,
        position=_rounded(body.xpos),
        up=round(float(body.xmat[8]), DIGITS),
        speed=round(float(np.linalg.norm(velocity)), DIGITS),
    )


def arm_report(humanoid: Humanoid, side: Side) -> ArmReported:
    """Return the positions of an arm's elbow and hand: m from its shoulder, along the torso's x, y and z."""
    data = humanoid.data
    shoulder = data.body(f"{side.letter}_shoulder_pitch_link").xpos
    axes = data.body("torso").xmat.reshape(3, 3)
    elbow = (data.body(f"{side.letter}_forearm").xpos - shoulder) @ axes
    hand = (data.site(f"{side.letter}_grip").xpos - shoulder) @ axes
    return ArmReported(side=side.letter, elbow=elbow.tolist(), hand=hand.tolist())


def _rounded(numbers: Iterable[float]) -> list[float]:
    return [round(float(number), DIGITS) for number in numbers]
