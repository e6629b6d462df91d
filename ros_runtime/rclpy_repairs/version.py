"""Which rclpy is installed: a repair is applied to the versions that need it and to no other."""

from __future__ import annotations

from importlib import metadata


def installed_version() -> str:
    """The version of rclpy, from the wheel's metadata where there is one: its egg-info lags behind."""
    try:
        return metadata.version("ros-rclpy")
    except metadata.PackageNotFoundError:
        return metadata.version("rclpy")


def numbers(version: str) -> tuple[int, ...]:
    """Return the first three numbers of `version`: "7.1.6" is (7, 1, 6)."""
    return tuple(int(part) for part in version.split(".")[:3] if part.isdigit())
