"""Ends a notebook's session."""

from __future__ import annotations

import atexit

from lab.client.connection import disconnect
from lab.client.interaction_log import log
from lab.pictures.live_view import stop_watching
from lab.running.programs import stop_programs
from lab.running.robot import end_robot, robot_is_running
from lab.running.student_nodes import stop_nodes


def stop_everything() -> None:
    """Stop all programs, nodes and the robot, and leave the ROS graph. `start_robot()` begins a new session."""
    had_robot = robot_is_running()
    _stop_everything()
    if had_robot:
        print("The robot has stopped, and so have the nodes and programs of this notebook.")


@atexit.register
def _stop_everything() -> None:
    stop_watching()
    stop_programs()
    stop_nodes()
    end_robot()
    disconnect()
    log.clear()
