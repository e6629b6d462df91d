"""Ends a notebook's session."""

from __future__ import annotations

import atexit

from lab.client.connection import disconnect
from lab.client.interaction_log import log
from lab.pictures.live_view import stop_watching
from lab.running.programs import stop_programs
from lab.running.robot import stop_robot
from lab.running.student_nodes import stop_nodes


@atexit.register
def stop_everything() -> None:
    """Stop all programs, nodes and the robot, and leave the ROS graph. `start_robot()` begins a new session."""
    stop_watching()
    stop_programs()
    stop_nodes()
    stop_robot()
    disconnect()
    log.clear()
