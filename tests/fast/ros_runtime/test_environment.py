"""The environment of every ROS process that the course starts."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ros_runtime import environment
from ros_runtime.environment import ros_environment, uses_wheels

wheels_only = pytest.mark.skipif(not uses_wheels(), reason="rclpy comes from a sourced ROS installation")


def run(code, variables):
    return subprocess.run(
        [sys.executable, "-c", code], env=variables, capture_output=True, text=True, check=True
    ).stdout.strip()


def test_a_process_with_nothing_else_in_its_environment_can_use_rclpy(tmp_path):
    variables = {**ros_environment(), "ROS_DOMAIN_ID": "93", "ROS_LOG_DIR": str(tmp_path)}
    variables["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    code = "import rclpy; rclpy.init(); rclpy.create_node('node').get_logger().info('hello'); print('fine')"
    assert run(code, variables) == "fine"
    assert any("hello" in log.read_text() for log in tmp_path.rglob("*.log"))


def test_a_field_of_the_wrong_type_is_refused_instead_of_sent_as_garbage():
    code = (
        "from geometry_msgs.msg import Point\n"
        "try: Point(x=1)\n"
        "except AssertionError as error: print('refused')"
    )
    assert run(code, os.environ | ros_environment()) == "refused"


@wheels_only
def test_the_wheels_do_not_start_the_interpreter_twice():
    code = "import os, sys; print(os.environ['LD_LIBRARY_PATH'])"
    found = run(code, ros_environment()).split(os.pathsep)
    assert found[0] == str(Path(sys.prefix) / "lib")  # in our order; the wheels would have shuffled it
    assert found == ros_environment()["LD_LIBRARY_PATH"].split(os.pathsep)


@wheels_only
def test_library_paths_of_the_user_are_kept(monkeypatch):
    monkeypatch.setenv("LD_LIBRARY_PATH", "/opt/mine/lib")
    assert ros_environment()["LD_LIBRARY_PATH"].endswith(":/opt/mine/lib")


def test_a_sourced_installation_keeps_what_its_setup_file_exported(monkeypatch):
    monkeypatch.setattr(environment, "_wheels_site_packages", lambda: None)
    monkeypatch.setenv("LD_LIBRARY_PATH", "/opt/ros/jazzy/lib")
    monkeypatch.setenv("AMENT_PREFIX_PATH", "/opt/ros/jazzy")
    variables = ros_environment()
    assert variables["LD_LIBRARY_PATH"] == "/opt/ros/jazzy/lib"
    assert variables["AMENT_PREFIX_PATH"] == "/opt/ros/jazzy"
    assert "_ROS_WHEELS_BOOTSTRAP_COMPLETE" not in variables
