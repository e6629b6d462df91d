"""Commands that a scenario sends through a pipe while grading, when the /sim services are absent."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from functools import partial

from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.humanoid import Humanoid
from robot_sim.model.side import Side
from robot_sim.ros.ground_truth import (
    GroundTruthWriter,
    arm_report,
    feet_truth,
    hand_truth,
    joints_reader,
    object_truth,
)
from robot_sim.ros.node import HumanoidNode

COMMANDS = (
    *("push", "walk", "take_over", "set_battery", "battery_sensor", "charge_sensor"),
    *("robot_state", "motor_power", "clock_offset"),
    *("joint_sensors", "joint_states", "joint_readings", "imu_sensor", "gyro_bias"),
    *("move_joints", "report_arm", "reset"),
    *("hold_joint", "release_joint", "report_joints", "report_feet", "move_body"),
    *("report_hand", "report_object", "move_object"),
)


class ScenarioControl:
    """A non-blocking reader of JSON lines such as {"do": "push", "impulse": [0, 60, 0]}."""

    def __init__(self, fd: int) -> None:
        os.set_blocking(fd, False)
        self._fd = fd
        self._pending = b""

    def commands(self) -> Iterator[dict]:
        """Yield the commands that have arrived since the last call."""
        try:
            while chunk := os.read(self._fd, 65536):
                self._pending += chunk
        except BlockingIOError:
            pass
        *lines, self._pending = self._pending.split(b"\n")
        for line in lines:
            yield json.loads(line)


def apply_command(
    command: dict, humanoid: Humanoid, node: HumanoidNode, ground_truth: GroundTruthWriter | None = None
) -> None:
    """Execute one command; a command to report something writes it to `ground_truth`.

    Raises:
        ValueError: the command is not known; the message lists the known ones.
    """
    match command:
        case {"do": "push", "impulse": impulse, **rest}:
            humanoid.push(impulse, rest.get("duration", 0.1))
        case {"do": "walk", "velocity": velocity}:
            humanoid.walk_velocity(*velocity)
        case {"do": "take_over", "velocity": velocity}:
            node.take_over(velocity)
        case {"do": "set_battery", "percentage": percentage}:
            humanoid.battery.set_percentage(percentage)
        case {"do": "battery_sensor", "connected": connected}:
            node.battery_sensor_connected = connected
        case {"do": "charge_sensor", "connected": connected}:
            node.charge_measured = connected
        case {"do": "clock_offset", "seconds": seconds}:
            node.clock_offset = round(seconds * 1e9)
        case {"do": "joint_sensors", "connected": connected}:
            node.joint_sensors_connected = connected
        case {"do": "joint_states", "reversed": is_reversed}:
            node.joint_states_reversed = is_reversed
        case {"do": "joint_states", "alternate": alternate}:
            node.joint_states_alternate = alternate
        case {"do": "joint_readings", "positions": positions}:
            node.joint_readings = dict(positions)
        case {"do": "imu_sensor", "connected": connected}:
            node.imu_connected = connected
        case {"do": "gyro_bias", "bias": bias}:
            humanoid.gyro_bias = bias
        case {"do": "move_joints", "positions": positions, "duration": duration}:
            goal = Waypoint(duration, tuple(positions.values()))
            humanoid.move_joints(JointTrajectory(tuple(positions), (goal,)))
        case {"do": "report_arm", "side": side} if ground_truth:
            ground_truth.write(arm_report(humanoid, Side.of_letter(side)))
        case {"do": "report_joints", "names": names} if ground_truth:
            ground_truth.report("joints", joints_reader(humanoid, names))
        case {"do": "report_feet"} if ground_truth:
            ground_truth.report("feet", partial(feet_truth, humanoid))
        case {"do": "move_body", "rate": rate}:
            humanoid.move_body(rate)
        case {"do": "report_hand", "side": side} if ground_truth:
            ground_truth.report(f"hand {side}", partial(hand_truth, humanoid, Side.of_letter(side)))
        case {"do": "report_object", "name": name} if ground_truth:
            ground_truth.report(f"object {name}", partial(object_truth, humanoid, name))
        case {"do": "move_object", "name": name, "position": position}:
            humanoid.move_object(name, position)
        case {"do": "hold_joint", "joint": joint}:
            humanoid.hold_joint(joint)
        case {"do": "release_joint", "joint": joint}:
            humanoid.release_joint(joint)
        case {"do": "robot_state", "published": published}:
            node.robot_state_published = published
        case {"do": "motor_power", "on": on}:
            humanoid.set_motor_power(on)
        case {"do": "reset", **pose}:
            humanoid.reset(
                pose.get("x", 0.0), pose.get("y", 0.0), pose.get("yaw", 0.0), height=pose.get("height")
            )
            node.restart()
        case _:
            raise ValueError(f"unknown command {command!r}; the commands are {', '.join(COMMANDS)}")
