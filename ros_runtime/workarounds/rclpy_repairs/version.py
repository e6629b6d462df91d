"""Which rclpy is installed: a repair is applied to the versions that need it and to no other."""

from __future__ import annotations

import os
import sys

PACKAGES = (
    "ros_rclpy",
    "rclpy",
)  # the wheels' metadata, then apt's, whose egg-info lags behind in the wheels


def installed_version() -> str:
    """Return the version of rclpy, as its metadata is named in the first folder of the path that has any.

    importlib.metadata tells the same, but costs every ROS process 20 ms of imports.

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
