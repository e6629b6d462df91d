"""The version of the installed rclpy: a repair is applied only to the versions that need it."""

from __future__ import annotations

import os
import sys

# The wheels' metadata comes first: the wheels also contain apt's "rclpy", but with an older version in its egg-info.
PACKAGES = ("ros_rclpy", "rclpy")


def installed_version() -> str:
    """Return the version of rclpy, read from the name of its metadata folder on the path.

    importlib.metadata returns the same, but importing it costs every ROS process 20 ms.

    Raises:
        LookupError: no rclpy is installed.
    """
    for package in PACKAGES:
        for folder in sys.path:
            for name in _list(folder):
                if name.startswith(f"{package}-") and name.endswith((".dist-info", ".egg-info")):
                    return name[len(package) + 1 :].rpartition(".")[0].partition("-")[0]
    raise LookupError(f"no metadata of {' or '.join(PACKAGES)} on the path: is rclpy installed?")


def numbers(version: str) -> tuple[int, ...]:
    """Return the first three numbers of `version`: "7.1.6" is (7, 1, 6)."""
    return tuple(int(part) for part in version.split(".")[:3] if part.isdigit())


def _list(folder: str) -> list[str]:
    try:
        return os.listdir(folder)
    except OSError:  # sys.path may contain files and missing folders
        return []
