"""A folder of definitions becomes a stock ROS 2 interface package, as colcon would build it too."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from ros_runtime.interface_build.definitions import Definition

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


def write_package(folder: Path, name: str, definitions: Sequence[Definition]) -> None:
    """Write package.xml, CMakeLists.txt and the definitions into `folder`."""
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
