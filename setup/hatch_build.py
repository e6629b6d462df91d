"""Build hook of this project's wheel, which adds the files that are not Python source.

- humanoid_interfaces, built with CMake: modules go to site-packages, libraries and share/ to the prefix;
- lib/libscaled_clock.so, the arena's clock, if there is a C compiler;
- the .pth file with which every Python process repairs rclpy (ros_runtime/workarounds/README.md).

Editable and normal wheels contain the same additions.
"""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from ros_runtime.interface_build.build_environment import PYTHON_LIB, sourced_prefixes
from ros_runtime.interface_build.cmake_package import build, built_prefix

ROOT = Path(__file__).resolve().parents[1]
BUILD_REQUIREMENTS = ROOT / "setup/build-requirements.txt"
# The interfaces are rebuilt when one of these files changes.
TOOLS = (BUILD_REQUIREMENTS, ROOT / "requirements.lock")


class CourseBuildHook(BuildHookInterface):
    """Called by hatchling for every wheel of this project."""

    def dependencies(self) -> list[str]:
        """Return the ROS build tools, unless ROS from apt is sourced or the interfaces are built already."""
        built = built_prefix(self._interfaces, self._builds, os.environ, TOOLS)
        if sourced_prefixes(os.environ) or built.is_dir():
            return []
        lines = BUILD_REQUIREMENTS.read_text(encoding="utf-8").splitlines()
        return [line for line in lines if line and not line.startswith("#")]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Fill `build_data`; `version` is "editable" or "standard"."""
        modules, prefix_files = _split(build(self._interfaces, self._builds, os.environ, TOOLS))
        modules |= {
            str(path): path.name for path in sorted((ROOT / "ros_runtime/workarounds").rglob("*.pth"))
        }
        clock = _build_scaled_clock(
            ROOT / "ros_runtime/workarounds/scaled_clock/compile_library.py", self._builds
        )
        if clock is not None:
            prefix_files[str(clock)] = "lib/libscaled_clock.so"
        build_data["force_include_editable" if version == "editable" else "force_include"].update(modules)
        build_data["shared_data"].update(prefix_files)
        build_data["pure_python"] = False
        build_data["infer_tag"] = True

    @property
    def _interfaces(self) -> Path:
        return ROOT / "humanoid_interfaces"

    @property
    def _builds(self) -> Path:
        return ROOT / "build/interfaces"


def _split(prefix: Path) -> tuple[dict[str, str], dict[str, str]]:
    """Map the built files to the wheel's root (Python modules) and to the prefix (all others)."""
    modules: dict[str, str] = {}
    others: dict[str, str] = {}
    for path in sorted(path for path in prefix.rglob("*") if path.is_file()):
        inside = path.relative_to(prefix)
        # The egg-info would be a second distribution, which pip could not uninstall.
        if any(part == "__pycache__" or part.endswith(".egg-info") for part in inside.parts):
            continue
        if inside.is_relative_to(PYTHON_LIB):
            modules[str(path)] = str(inside.relative_to(PYTHON_LIB))
        else:
            others[str(path)] = str(inside)
    return modules, others


def _build_scaled_clock(compile_module: Path, builds: Path) -> Path | None:
    """Compile the arena's clock and return the library; if that fails, print a warning and return None."""
    spec = spec_from_file_location("compile_library", compile_module)
    if spec is None or spec.loader is None:
        raise RuntimeError(
            f"{compile_module} cannot be imported; expected a Python module that compiles the clock."
        )
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    builds.mkdir(parents=True, exist_ok=True)
    library = builds / "libscaled_clock.so"
    try:
        module.compile_library(library)
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"warning: libscaled_clock.so is left out, the arena runs at scale 1: {error}", file=sys.stderr)
        return None
    return library
