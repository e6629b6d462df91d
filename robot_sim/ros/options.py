"""The options of the robot, and their command line."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass

from robot_sim.body import ROBOTS
from robot_sim.model.scenes import SCENES


@dataclass(frozen=True)
class RobotOptions:
    """How to run the robot.

    Attributes:
        rtf: real-time factor, simulated seconds per second; 0: as fast as possible.
        namespace: of the node.
        view: show it in a browser, served at `port` (0: the first free from 8080 on).
        robot: one of `body.ROBOTS`.
        scene, crouch, seed: the scene, whether the robot begins in a crouch, and the seed of the sensors' noise.
        ground_truth_fd, control_fd: descriptors of the arena's pipes; with control_fd the robot is graded and /sim is
            absent.
        battery_sensor_unplugged, joint_sensors_unplugged, robot_state_unpublished: faults present from the start.
        postures: also write the whole posture to the ground truth, for a recording.
        may_rest: physics is not integrated while the robot stands still without a command.
    """

    rtf: float = 1.0
    namespace: str = "/robot"
    view: bool = False
    port: int = 0
    robot: str = "humanoid"
    scene: str = "flat"
    crouch: bool = False
    seed: int = 0
    ground_truth_fd: int | None = None
    control_fd: int | None = None
    battery_sensor_unplugged: bool = False
    joint_sensors_unplugged: bool = False
    robot_state_unpublished: bool = False
    postures: bool = False
    may_rest: bool = False


def parse_options(arguments: Sequence[str] | None = None) -> RobotOptions:
    """Parse a command line, by default that of this process; invalid options end the process with a message."""
    return RobotOptions(**vars(_parser().parse_args(arguments)))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="course sim", description="Run the humanoid under ROS 2.")
    parser.add_argument(
        "--rtf",
        type=_factor,
        default=1.0,
        help="simulated seconds per second; 0: as fast as possible (default 1)",
    )
    parser.add_argument("--namespace", default="/robot", help="ROS namespace (default /robot)")
    parser.add_argument("--view", action="store_true", help="show the robot in a browser on this machine")
    parser.add_argument(
        "--port", type=int, default=0, help="port of the view (default: the first free one from 8080 on)"
    )
    parser.add_argument("--robot", choices=ROBOTS, default="humanoid", help="which robot (default humanoid)")
    parser.add_argument(
        "--scene", choices=tuple(SCENES), default="flat", help="what is around the robot (default flat)"
    )
    parser.add_argument("--crouch", action="store_true", help="begin in a crouch instead of standing")
    parser.add_argument("--seed", type=int, default=0, help="seed of the sensors' noise (default 0)")
    parser.add_argument("--ground-truth-fd", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--control-fd", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--battery-sensor-unplugged", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--joint-sensors-unplugged", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--robot-state-unpublished", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--postures", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--may-rest", action="store_true", help=argparse.SUPPRESS)
    return parser


def _factor(text: str) -> float:
    value = float(text)
    if not 0 <= value <= 100:
        raise argparse.ArgumentTypeError(f"must lie between 0 and 100, got {text}")
    return value
