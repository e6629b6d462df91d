"""The end of a session."""

from __future__ import annotations

import atexit

from lab.connection import disconnect
from lab.interaction_log import log
from lab.live_view import stop_watching
from lab.programs import stop_programs
from lab.robot import stop_robot
from lab.student_nodes import stop_nodes


@atexit.register
def stop_everything() -> None:
    """Stop all programs, nodes and the robot, and leave the ROS graph. `start_robot()` starts again."""
    stop_watching()
    stop_programs()
    stop_nodes()
    stop_robot()
    disconnect()
    log.clear()
