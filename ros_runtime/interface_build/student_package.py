"""Turns a folder of a student's definitions into a stock interface package, builds it, and makes it importable."""

from __future__ import annotations

import importlib
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rosidl_adapter.parser import is_valid_package_name

from ros_runtime.interface_build import cmake_package
from ros_runtime.interface_build.build_environment import PYTHON_LIB, ros_build
from ros_runtime.interface_build.definitions import Definition, InvalidDefinitions, Problem, read_definitions
from ros_runtime.interface_build.known_types import KnownTypes
from ros_runtime.workarounds.late_libraries import load_on_import

PACKAGE_XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>Interfaces that a student of the course wrote.</description>
  <maintainer email="student@humanoid-course.org">A student of the course</maintainer>
  <license>Apache-2.0</license>

  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
{depends}
  <exec_depend>rosidl_default_runtime</exec_depend>

  <member_of_group>rosidl_interface_packages</member_of_group>

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""

CMAKE_LISTS = """\
cmake_minimum_required(VERSION 3.10)
project({name})

find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
{finds}
rosidl_generate_interfaces(${{PROJECT_NAME}}
{files}
  DEPENDENCIES {uses}
)

ament_export_dependencies(rosidl_default_runtime)
ament_package()
"""


@dataclass(frozen=True)
class BuiltPackage:
    """A package that can be imported; `is_new` means that it was built just now; `seconds` is the time that it took."""

    name: str
    prefix: Path
    definitions: Sequence[Definition]
    seconds: float
    is_new: bool

    def variables(self, environ: Mapping[str, str]) -> dict[str, str]:
        """Return the variables that let a process with the environment `environ` import the package."""
        return {
            "PYTHONPATH": self._put_first(self.prefix / PYTHON_LIB, environ.get("PYTHONPATH", "")),
            "LD_LIBRARY_PATH": self._put_first(self.prefix / "lib", environ.get("LD_LIBRARY_PATH", "")),
        }

    def prefix_path(self, environ: Mapping[str, str]) -> str:
        """Return AMENT_PREFIX_PATH for a process with that environment, so that `ros2` finds the definitions."""
        return self._put_first(self.prefix, environ.get("AMENT_PREFIX_PATH", ""))

    def is_importable_here(self) -> bool:
        """Return whether this process can import the package; it cannot if it has imported another build of it."""
        imported = getattr(sys.modules.get(self.name), "__file__", None)
        return imported is None or Path(imported).is_relative_to(self.prefix)

    def make_importable_here(self) -> None:
        """Make the package importable in this process."""
        load_on_import(self.name, self.prefix / "lib")
        sys.path[:] = [str(self.prefix / PYTHON_LIB), *filter(self._is_no_other_build, sys.path)]
        importlib.invalidate_caches()
        if getattr(sys.modules.get(self.name), "__file__", None) is None:
            self._forget_the_folder()

    def _forget_the_folder(self) -> None:
        """Undo an earlier import, in which Python took the folder of definitions for a package."""
        for module in [each for each in sys.modules if each.partition(".")[0] == self.name]:
            del sys.modules[module]

    def _put_first(self, path: Path, paths: str) -> str:
        """Return a search path with `path` first, and without other builds of this package."""
        others = [entry for entry in paths.split(os.pathsep) if entry]
        return os.pathsep.join([str(path), *filter(self._is_no_other_build, others)])

    def _is_no_other_build(self, path: str) -> bool:
        return not path.startswith(f"{self.prefix.parent}{os.sep}{self.name}-{sys.implementation.cache_tag}-")


def build_package(source: Path, builds: Path, name: str) -> BuiltPackage:
    """Build the definitions in `source` as package `name` into a folder of its own below `builds`.

    The same definitions are not built twice. A build takes about five seconds on two cores for a service and an action.

    Raises:
        InvalidDefinitions: it names file, line, what is wrong and what was expected.
        RuntimeError: the definitions seem correct but the build failed; the message ends with its output.
    """
    started = time.monotonic()
    builds = builds.resolve()
    environ = without_packages_in(builds, os.environ)
    definitions = checked_definitions(source, name, environ)
    builds.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f"{name}-source-", dir=builds) as scratch:
        package = Path(scratch) / name
        write_package(package, name, definitions)
        is_new = not cmake_package.built_prefix(package, builds, environ).is_dir()
        prefix = cmake_package.build(package, builds, environ)
    return BuiltPackage(name, prefix, definitions, time.monotonic() - started, is_new)


def checked_definitions(source: Path, name: str, environ: Mapping[str, str]) -> list[Definition]:
    """Read the definitions in `source`, which are to become package `name`.

    Raises:
        InvalidDefinitions: it names file, line, what is wrong and what was expected.
    """
    ros = ros_build(environ)
    prefixes = [Path(entry) for entry in ros.environment["AMENT_PREFIX_PATH"].split(os.pathsep) if entry]
    _require_free_name(name, prefixes)
    return read_definitions(source, name, KnownTypes.installed(prefixes))


def write_package(folder: Path, name: str, definitions: Sequence[Definition]) -> None:
    """Write package.xml, CMakeLists.txt and the definitions into `folder`; colcon could build it, too."""
    files = {f"{each.kind}/{each.file.name}": each.file for each in definitions}
    uses = sorted({"action_msgs", *(package for each in definitions for package in each.uses)} - {name})
    for place, file in files.items():
        target = folder / place
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, target)
    depends = "\n".join(f"  <depend>{package}</depend>" for package in uses)
    (folder / "package.xml").write_text(PACKAGE_XML.format(name=name, depends=depends), encoding="utf-8")
    lists = CMAKE_LISTS.format(
        name=name,
        finds="\n".join(f"find_package({package} REQUIRED)" for package in uses),
        files="\n".join(f'  "{place}"' for place in files),
        uses=" ".join(uses),
    )
    (folder / "CMakeLists.txt").write_text(lists, encoding="utf-8")


def without_packages_in(builds: Path, environ: Mapping[str, str]) -> dict[str, str]:
    """Return the environment without the packages in `builds`, which are not part of the ROS that a build uses."""
    entries = environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    others = [entry for entry in entries if entry and not Path(entry).is_relative_to(builds)]
    return {**environ, "AMENT_PREFIX_PATH": os.pathsep.join(others)}


def _require_free_name(name: str, prefixes: Sequence[Path]) -> None:
    if not is_valid_package_name(name):
        wanted = "small letters, digits and single _, a letter first, such as my_interfaces"
        raise InvalidDefinitions([Problem(name, 0, "", "this cannot be the name of a package", wanted)])
    if any((prefix / "share" / name).is_dir() for prefix in prefixes):
        raise InvalidDefinitions(
            [Problem(name, 0, "", "a package of this name is installed", "another name")]
        )
