"""Starts and stops the robot, which is the simulator and its ROS node in a process of its own."""

from __future__ import annotations

import os
import signal
from contextlib import suppress

import psutil

from lab.client import topics
from lab.client.connection import NAMESPACE, ROBOT_NODE, connection
from lab.client.topics import START_TIMEOUT
from lab.client.waiting import becomes_true
from lab.errors import NoRobotError
from lab.pictures.live_view import watch_beside_the_notebook
from lab.running.processes import GRACE, Process
from robot_sim.body import MissingParts, body_named
from robot_sim.model.scenes import OBJECTS
from ros_runtime.cell_notice import notice
from ros_runtime.notebook_domains import announce_robot, expect_node, forget_node, robot_of_another_notebook

_robot: Process | None = None


def start_robot(scene: str = "flat", *, robot: str = "humanoid") -> None:
    """Start the robot and wait for the first message on each of its topics; do nothing if it is already running.

    In `course lab` the robot is shown beside the notebook, and a robot that another notebook has started ends.
    In the scene "stand" a stand holds the robot by the chest, so that it does not fall without power. In the scene
    "table" there are a table and a cup. The robot "g1" is another one, with a learned walker (docs/robot.md).

    Raises:
        NoRobotError: the robot does not start within 30 s; the message quotes the robot's output. Or packages of the
            G1 are missing; the message has the command that installs them.
        ValueError: the robot is not known.
    """
    global _robot
    try:
        body_named(robot)
    except MissingParts as error:
        raise NoRobotError(str(error)) from None
    domain_id = connection().domain_id  # also sets the environment that the child inherits
    ended = ""
    if _robot is None or not _robot.is_running:
        ended = _end_robot_of_another_notebook()
        topics.reset_for_scene(scene, robot)
        rest = () if OBJECTS[scene] else ("--may-rest",)  # a cup never lies still enough for a rest
        options = ("--namespace", NAMESPACE, "--rtf", "1", "--robot", robot, "--scene", scene, *rest)
        _robot = Process(["-m", "robot_sim", *options])
        announce_robot(domain_id, _robot.pid)
    watch_beside_the_notebook()
    process = _robot
    with notice("The robot is starting, which takes a few seconds, on a busy machine up to 30 s."):
        is_up = becomes_true(lambda: topics.has_published() or not process.is_running, START_TIMEOUT)
    if not is_up:
        raise NoRobotError(
            f"the robot runs, but not all of its topics were received within {START_TIMEOUT:g} s. The machine may be "
            f"too busy; try lab.restart_robot(). The robot printed:\n{process.output()}"
        )
    if not process.is_running:
        raise NoRobotError(
            f"the robot's process ended with exit status {process.exit_status}; it printed:\n{process.output()}"
        )
    forget_node(ROBOT_NODE)  # an entry of a robot that was already running, or that crashed
    expect_node(ROBOT_NODE)
    lies = " It lies: lab.restart_robot() sets it up again." if topics.fell_at() else ""
    print(
        f"The robot {'runs' if lies else 'is up'} in namespace {NAMESPACE}, ROS_DOMAIN_ID {domain_id}.{lies}{ended}"
    )


def _end_robot_of_another_notebook() -> str:
    """End the robot that another notebook of the lab has started; return a sentence about it, "" if there is none."""
    other = robot_of_another_notebook()
    if other is None or not _is_robot(other.pid):
        return ""
    with suppress(ProcessLookupError):
        os.kill(other.pid, signal.SIGINT)
        if not becomes_true(lambda: not _is_robot(other.pid), GRACE):
            os.kill(other.pid, signal.SIGKILL)
    return f" The robot of {other.notebook} has ended: you have one robot at a time."


def _is_robot(pid: int) -> bool:
    """Whether this process is a robot that runs; another process can have the id of one that has ended."""
    try:
        return "robot_sim" in psutil.Process(pid).cmdline()
    except psutil.NoSuchProcess:  # or its parent has not asked for its exit status yet
        return False


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


def restart_robot(scene: str = "flat", *, robot: str = "humanoid") -> None:
    """Stop the robot and start a new one, which stands at the origin with a full battery."""
    end_robot()
    start_robot(scene, robot=robot)


def stop_robot() -> None:
    """Stop the robot's process."""
    if robot_is_running():
        print("The robot has stopped.")
    end_robot()


def end_robot() -> None:
    """Stop the robot's process and print nothing."""
    global _robot
    forget_node(ROBOT_NODE)
    if _robot is not None:
        _robot.stop()
        _robot = None
        topics.forget_messages()
