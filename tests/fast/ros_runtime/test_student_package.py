"""Building a student's package while others are already built."""

from __future__ import annotations

from pathlib import Path

from ros_runtime.interface_build.student_package import without_packages_in


def test_packages_built_by_the_same_notebook_do_not_count_as_installed() -> None:
    environ = {
        "AMENT_PREFIX_PATH": "/notebook/.interfaces/my_interfaces-1:/opt/ros/jazzy",
        "HOME": "/home/me",
    }
    assert without_packages_in(Path("/notebook/.interfaces"), environ) == {
        "AMENT_PREFIX_PATH": "/opt/ros/jazzy",
        "HOME": "/home/me",
    }
    assert without_packages_in(Path("/notebook/.interfaces"), {}) == {"AMENT_PREFIX_PATH": ""}
