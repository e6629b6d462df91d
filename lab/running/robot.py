"""Starts and stops the robot, which is the simulator and its ROS node in a process of its own."""

from __future__ import annotations

import os
from contextlib import suppress

import psutil

from lab.client import topics
from lab.client.connection import NAMESPACE, connection
from lab.client.waiting import becomes_true
from lab.errors import NoRobotError
from lab.notices import notice
from lab.running.processes import Process
from ros_runtime import notebook_domains
from ros_runtime.notebook_domains import expect_node, forget_node

START_TIMEOUT = 30.0  # s
COMMAND = ["-m", "robot_sim", "--namespace", NAMESPACE, "--rtf", "1"]
NODE_NAME = f"{NAMESPACE}/humanoid"

_robot: Process | None = None


def start_robot(scene: str = "flat") -> None:
    """Start the robot and wait for the first message on each of its topics; do nothing if it is already running.

    In the scene "stand" a stand holds the robot by the chest, so that it does not fall without power. In the scene
    "table" there are a table and a cup.

    Raises NoRobotError when the robot does not start within 30 s; the message quotes the robot's output.
    """
    global _robot
    domain_id = connection().domain_id  # also sets the environment that the child inherits
    if _robot is None or not _robot.is_running:
        topics.reset_for_scene(scene)
        _robot = Process([*COMMAND, "--scene", scene])
    robot = _robot
    with notice("The robot is starting, which takes a few seconds, on a busy machine up to 30 s."):
        is_up = becomes_true(lambda: topics.has_published() or not robot.is_running, START_TIMEOUT)
    if not is_up:
        raise NoRobotError(
            f"the robot runs, but not all of its topics were received within {START_TIMEOUT:g} s. The machine may be "
            f"too busy; try lab.restart_robot(). The robot printed:\n{robot.output()}"
        )
    if not robot.is_running:
        raise NoRobotError(
            f"the robot's process ended with exit status {robot.exit_status}; it printed:\n{robot.output()}"
        )
    forget_node(NODE_NAME)  # an entry of a robot that was already running, or that crashed
    expect_node(NODE_NAME)
    print(f"The robot is up in namespace {NAMESPACE}, ROS_DOMAIN_ID {domain_id}.")
    if others := _robots_of_other_notebooks():
        print(
            f"Robots of other notebooks that still run: {others}. Each takes a tenth of a processor. "
            "lab.stop_everything() in its notebook ends it, and so does shutting down that notebook's kernel."
        )


def _robots_of_other_notebooks() -> int:
    """Return how many robots run in the same JupyterLab, apart from this notebook's."""
    started_by = os.environ.get(notebook_domains.VARIABLE)
    found = 0
    for process in psutil.process_iter() if started_by else ():
        with suppress(psutil.Error):  # it has ended, or belongs to somebody else
            is_robot = process.cmdline()[1:3] == COMMAND[:2] and process.ppid() != os.getpid()
            found += is_robot and process.environ().get(notebook_domains.VARIABLE) == started_by
    return found


def robot_is_running() -> bool:
    """Whether the robot that `start_robot()` started still runs."""
    return _robot is not None and _robot.is_running


def robot_process() -> Process:
    """Return the process of the robot that `start_robot()` started.

    Raises NoRobotError when no robot runs.
    """
    if _robot is None or not _robot.is_running:
        raise NoRobotError("no robot is running; try lab.start_robot()")
    return _robot


def restart_robot(scene: str = "flat") -> None:
    """Stop the robot and start a new one, which stands at the origin with a full battery."""
    stop_robot()
    start_robot(scene)


def stop_robot() -> None:
    """Stop the robot's process."""
    global _robot
    forget_node(NODE_NAME)
    if _robot is not None:
        _robot.stop()
        _robot = None
