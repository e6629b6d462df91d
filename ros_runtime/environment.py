"""The environment of every ROS process that the lab and the arena start."""

from __future__ import annotations

import os
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path

# The setup files of ROS export these; a process that starts with an empty environment needs them.
_SETUP_FILE_VARIABLES = (
    "AMENT_PREFIX_PATH",
    "CMAKE_PREFIX_PATH",
    "LD_LIBRARY_PATH",
    "PYTHONPATH",
    "ROS_DISTRO",
    "ROS_PYTHON_VERSION",
    "ROS_VERSION",
)


def ros_environment() -> dict[str, str]:
    """Return the variables to add to a process's environment, which may be empty or a copy of this process's."""
    variables = {
        "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
        # Shared memory does not work across sandboxes and leaves files behind when a process is killed.
        "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4",
        # Otherwise Fast DDS loads a profile file from the working directory.
        "SKIP_DEFAULT_XML_FILE": "1",
        # Without it rclpy silently sends a field of the wrong type as garbage.
        "ROS_PYTHON_CHECK_FIELDS": "1",
        "PYTHONUNBUFFERED": "1",
        "RCUTILS_COLORIZED_OUTPUT": "0",
        # numpy would start a thread per core for matrices of at most a few dozen rows.
        "OPENBLAS_NUM_THREADS": "1",
    }
    return variables | _library_variables()


def uses_wheels() -> bool:
    """Return whether rclpy comes from the wheels on PyPI rather than from a sourced ROS installation."""
    return _wheels_site_packages() is not None


def _library_variables() -> dict[str, str]:
    """Return the variables by which the loader finds ROS's libraries.

    The wheels set LD_LIBRARY_PATH by starting the interpreter a second time (20 ms). They skip that if
    _ROS_WHEELS_BOOTSTRAP_COMPLETE is set, so both variables are set here. A sourced ROS has set everything already.
    """
    site_packages = _wheels_site_packages()
    if site_packages is None:
        return {name: os.environ[name] for name in _SETUP_FILE_VARIABLES if name in os.environ}
    ours = [str(Path(sys.prefix) / "lib"), *sorted(str(path) for path in site_packages.glob("ros_*.libs"))]
    inherited = [path for path in os.environ.get("LD_LIBRARY_PATH", "").split(os.pathsep) if path]
    paths = dict.fromkeys([*ours, *inherited])
    return {"LD_LIBRARY_PATH": os.pathsep.join(paths), "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"}


@cache
def _wheels_site_packages() -> Path | None:
    """Return the directory in which the wheels are installed; None if rclpy is imported from elsewhere."""
    rclpy, bootstrapper = find_spec("rclpy"), find_spec("ros_wheels_bootstrapper")
    if rclpy is None or rclpy.origin is None or bootstrapper is None or bootstrapper.origin is None:
        return None
    site_packages = Path(bootstrapper.origin).parents[1]
    return site_packages if Path(rclpy.origin).is_relative_to(site_packages) else None
