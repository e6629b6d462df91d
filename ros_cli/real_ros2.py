"""Finds the `ros2` of a sourced ROS 2, which replaces the course's own command."""

from __future__ import annotations

import os
import shutil
from contextlib import suppress
from pathlib import Path

from ros_runtime.environment import uses_wheels

OURS = Path(__file__).with_name("bin")  # `course lab` puts it on the PATH


def real_ros2() -> str | None:
    """Return the path of the real `ros2`; None if there is none, or if rclpy comes from wheels, which it cannot use."""
    if uses_wheels():
        return None
    folders = os.environ.get("PATH", "").split(os.pathsep)
    return shutil.which("ros2", path=os.pathsep.join(folder for folder in folders if folder != str(OURS)))


def path_with_ros2(path: str) -> str:
    """Return a PATH with the course's `ros2` command, which joins the lab's domain and may execute the real one.

    If an unpacking tool has dropped the command's executable bit, set it.
    """
    command = OURS / "ros2"
    if not os.access(command, os.X_OK):
        with suppress(OSError):  # the file belongs to another user
            command.chmod(0o755)
    return os.pathsep.join([str(OURS), *filter(None, path.split(os.pathsep))])
