"""The build hook: the ROS 2 that it builds with, and the reuse of a finished build."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest

from ros_runtime.interface_build import build_environment, cmake_package

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def jazzy(tmp_path: Path) -> Path:
    """A prefix with the layout of /opt/ros/jazzy, for the Python that runs the tests."""
    prefix = tmp_path / "opt/ros/jazzy"
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    (prefix / f"lib/python{version}/site-packages/rclpy").mkdir(parents=True)
    return prefix


def test_a_sourced_jazzy_is_used_as_colcon_would_use_it(jazzy: Path) -> None:
    environ = {
        "ROS_DISTRO": "jazzy",
        "AMENT_PREFIX_PATH": f"/clone/.venv:{jazzy}",
        "VIRTUAL_ENV": "/clone/.venv",
    }

    ros = build_environment.ros_build(environ)

    assert not ros.from_wheels
    assert str(jazzy / build_environment.PYTHON_LIB) in ros.environment["PYTHONPATH"].split(":")
    assert str(jazzy) in ros.environment["CMAKE_PREFIX_PATH"].split(":")
    assert "VIRTUAL_ENV" not in ros.environment
    assert ros.python.parent == Path(sys.base_prefix) / "bin"


@pytest.mark.parametrize(
    "difference", [{"ROS_DISTRO": "humble"}, {"ROS_DISTRO": ""}, {"AMENT_PREFIX_PATH": "/elsewhere"}]
)
def test_another_ros_distribution_is_ignored(jazzy: Path, difference: dict[str, str]) -> None:
    environ = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": str(jazzy)}
    sourced_prefixes = build_environment.sourced_prefixes
    assert sourced_prefixes(environ) == [jazzy]

    assert sourced_prefixes({**environ, **difference}) == []


def test_without_any_ros_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build_environment, "find_spec", lambda name: None)

    with pytest.raises(RuntimeError, match=r"setup/build-requirements\.txt"):
        build_environment.ros_build({})


def test_a_finished_build_is_used_again_until_a_source_changes(tmp_path: Path) -> None:
    source = tmp_path / "humanoid_interfaces"
    shutil.copytree(ROOT / "humanoid_interfaces", source)
    prefix = cmake_package.built_prefix(source, tmp_path / "build", {})
    prefix.mkdir(parents=True)

    assert cmake_package.build(source, tmp_path / "build", {}) == prefix

    with (source / "msg/RobotState.msg").open("a", encoding="utf-8") as message:
        message.write("bool waving\n")
    assert cmake_package.built_prefix(source, tmp_path / "build", {}) != prefix


def test_without_a_compiler_the_error_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))

    with pytest.raises(RuntimeError, match=r"apt-get install -y g\+\+"):
        cmake_package.build(ROOT / "humanoid_interfaces", tmp_path / "build", {})


def test_a_failing_build_shows_the_end_of_its_output(tmp_path: Path) -> None:
    log = tmp_path / "build.log"
    script = "echo 'RobotState.msg: unknown type'; exit 3"

    with (
        log.open("w") as output,
        pytest.raises(RuntimeError, match=r"status 3 of(.|\n)*unknown type(.|\n)*build\.log"),
    ):
        cmake_package._run(["sh", "-c", script], {"PATH": "/bin"}, output, log)
