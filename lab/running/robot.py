"""Start and stop the robot: the simulator with its ROS node, as a process of its own."""

from __future__ import annotations

from lab.client import topics
from lab.client.connection import NAMESPACE, connection
from lab.client.waiting import comes_true
from lab.errors import NoRobotError
from lab.running.processes import Process
from ros_runtime.notebook_domains import expect_node, forget_node

START_TIMEOUT = 30.0  # s
NODE = f"{NAMESPACE}/humanoid"

_robot: Process | None = None


def start_robot(scene: str = "flat") -> None:
    """Start the robot and wait for the first message on each of its topics. Does nothing if it is running.

    In the scene "stand" a stand holds it by the chest, so that it does not fall without power; "table" has a cup.

    Raises NoRobotError, quoting the robot's output, when it does not start within 30 s.
    """
    global _robot
    domain_id = connection().domain_id  # also sets the environment that the child inherits
    if _robot is None or not _robot.is_running:
        topics.enter(scene)
        _robot = Process(["-m", "robot_sim", "--namespace", NAMESPACE, "--rtf", "1", "--scene", scene])
    robot = _robot
    if not comes_true(lambda: topics.has_published() or not robot.is_running, START_TIMEOUT):
        raise NoRobotError(
            f"the robot runs, but nothing arrived from it within {START_TIMEOUT:g} s: is the machine very busy? "
            f"Try lab.restart_robot(). It printed:\n{robot.output()}"
        )
    if not robot.is_running:
        raise NoRobotError(
            f"the robot ended with exit status {robot.exit_status}; it printed:\n{robot.output()}"
        )
    forget_node(NODE)  # the process that was already running, or that crashed
    expect_node(NODE)
    print(f"The robot is up in namespace {NAMESPACE}, ROS_DOMAIN_ID {domain_id}.")


def robot_process() -> Process:
    """The process of the robot that `start_robot()` started.

    Raises NoRobotError when it does not run.
    """
    if _robot is None or not _robot.is_running:
        raise NoRobotError("no robot is running; try lab.start_robot()")
    return _robot


def restart_robot(scene: str = "flat") -> None:
    """Replace the robot by one that stands at the origin with a full battery."""
    stop_robot()
    start_robot(scene)


def stop_robot() -> None:
    """End the robot's process."""
    global _robot
    forget_node(NODE)
    if _robot is not None:
        _robot.stop()
        _robot = None
