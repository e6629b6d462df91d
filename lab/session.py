"""The end of a session."""

from __future__ import annotations

import atexit

from lab import story
from lab.connection import disconnect
from lab.live_view import stop_watching
from lab.programs import stop_programs
from lab.robot import stop_robot
from lab.student_nodes import stop_nodes


@atexit.register
def stop_everything() -> None:
    """Stop the students' programs and nodes and the robot, and leave the ROS graph; `start_robot()` begins anew."""
    stop_watching()
    stop_programs()
    stop_nodes()
    stop_robot()
    disconnect()
    story.forget()
