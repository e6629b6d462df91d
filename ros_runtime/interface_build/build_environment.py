"""Which ROS 2 a build uses, and the environment its tools need.

ROS 2 Jazzy from apt is used where it is sourced, the ROS wheels from PyPI everywhere else.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

PYTHON_LIB = f"lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages"


@dataclass(frozen=True)
class RosBuild:
    """Where a build finds ROS 2.

    Attributes:
        python: interpreter that runs the interface generators.
        environment: environment variables of CMake and everything it starts.
        from_wheels: whether ROS 2 comes from PyPI.
    """

    python: Path
    environment: Mapping[str, str]
    from_wheels: bool


def sourced_prefixes(environ: Mapping[str, str]) -> list[Path]:
    """Return the prefixes of a sourced ROS 2 Jazzy whose rclpy fits this Python; empty if there is none."""
    if environ.get("ROS_DISTRO") != "jazzy":
        return []
    prefixes = [Path(entry) for entry in environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if entry]
    return prefixes if any((prefix / PYTHON_LIB / "rclpy").is_dir() for prefix in prefixes) else []


def ros_build(environ: Mapping[str, str]) -> RosBuild:
    """Return the ROS 2 that a build started with `environ` uses.

    Raises:
        RuntimeError: ROS 2 is neither sourced nor among the build requirements.
    """
    prefixes = sourced_prefixes(environ)
    return _from_apt(environ, prefixes) if prefixes else _from_wheels(environ)


def _from_apt(environ: Mapping[str, str], prefixes: list[Path]) -> RosBuild:
    """Return the sourced ROS with the system's Python, as colcon uses it: it has the generators' requirements."""
    environment = {
        name: value for name, value in environ.items() if name not in ("VIRTUAL_ENV", "PYTHONHOME")
    }
    # CMake finds packages by this variable. A colcon workspace sets it; /opt/ros alone may not.
    environment["CMAKE_PREFIX_PATH"] = os.pathsep.join(
        [*map(str, prefixes), environ.get("CMAKE_PREFIX_PATH", "")]
    )
    environment["PYTHONPATH"] = os.pathsep.join(str(prefix / PYTHON_LIB) for prefix in prefixes)
    python = Path(sys.base_prefix) / f"bin/python{sys.version_info.major}.{sys.version_info.minor}"
    return RosBuild(python, environment, from_wheels=False)


def _from_wheels(environ: Mapping[str, str]) -> RosBuild:
    """Return the ROS of the wheels, which install a whole prefix around site-packages."""
    generators = find_spec("rosidl_cmake")
    if generators is None or generators.origin is None:
        raise RuntimeError(
            "The ROS build tools are missing: Python module rosidl_cmake was not found.\n"
            "Install with build isolation (the default of pip and uv), or setup/build-requirements.txt first."
        )
    site_packages = Path(generators.origin).parents[1]
    prefix = site_packages.parents[2]
    libraries = [prefix / "lib", *sorted(site_packages.glob("ros_*.libs"))]
    environment = {
        **environ,
        "AMENT_PREFIX_PATH": str(prefix),
        "CMAKE_PREFIX_PATH": str(prefix),
        # Only the wheels: the entry that pip adds for build isolation would break the generators.
        "PYTHONPATH": str(site_packages),
        "LD_LIBRARY_PATH": os.pathsep.join(map(str, libraries)),
        "PATH": os.pathsep.join([str(prefix / "bin"), environ.get("PATH", os.defpath)]),
        # The library path is set above, so the wheels need not start Python a second time to set it.
        "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",
    }
    return RosBuild(Path(sys.executable), environment, from_wheels=True)
