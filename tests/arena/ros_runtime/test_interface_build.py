"""A student's definitions become a package that new and running processes can import and use with rclpy."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ros_runtime.environment import ros_environment
from ros_runtime.interface_build import cmake_package
from ros_runtime.interface_build.definitions import InvalidDefinitions
from ros_runtime.interface_build.student_package import build_package

SRV = "geometry_msgs/PointStamped target\n---\nint32 NO_WAY=-31\nint32 error_code\nfloat64 distance\n"
ACTION = "float64 distance\n---\nuint16 NONE=0\nuint16 error_code\n---\nfloat64 distance_remaining\n"
ODD_NAME = 'Téléchargements & "what\'s in" them'  # a realistic folder name; CMake can handle none of these characters
USE = """
import rclpy
from my_interfaces.action import Go
from my_interfaces.srv import Ask
from rclpy.action import ActionClient, ActionServer

def succeed(goal_handle):
    goal_handle.succeed()
    return Go.Result(error_code=7)

def answer(request, response):
    response.distance = 2 * request.target.point.x
    response.error_code = Ask.Response.NO_WAY
    return response

rclpy.init()
node = rclpy.create_node("both_ends")
node.create_service(Ask, "ask", answer)
server = ActionServer(node, Go, "go", succeed)
request = Ask.Request()
request.target.point.x = 1.5
client, goals = node.create_client(Ask, "ask"), ActionClient(node, Go, "go")
assert client.wait_for_service(20) and goals.wait_for_server(20)

def wait(future):
    rclpy.spin_until_future_complete(node, future, timeout_sec=20)
    return future.result()

print(wait(client.call_async(request)))
goal_handle = wait(goals.send_goal_async(Go.Goal(distance=1.0)))
print(wait(goal_handle.get_result_async()).result)
"""
IMPORT_HERE = """
import sys
from pathlib import Path
from ros_runtime.interface_build.student_package import build_package
package = build_package(Path(sys.argv[1]), Path(sys.argv[2]), "my_interfaces")
print(package.is_new, package.is_importable_here())
package.make_importable_here()
print("" in sys.path, "libmy_interfaces" in Path("/proc/self/maps").read_text())
"""


def run(*arguments: object, **variables: str) -> subprocess.CompletedProcess[str]:
    """A Python process in a ROS domain of its own."""
    environment = os.environ | ros_environment() | {"ROS_DOMAIN_ID": str(os.getpid() % 100 + 1)} | variables
    return subprocess.run(
        [sys.executable, *map(str, arguments)], env=environment, capture_output=True, text=True, timeout=600
    )


def build(source: Path, out: Path, name: str = "my_interfaces") -> subprocess.CompletedProcess[str]:
    return run("-m", "ros_runtime.interface_build", source, out, "--name", name)


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp(ODD_NAME)
    (folder / "Ask.srv").write_text(SRV)
    (folder / "Go.action").write_text(ACTION)
    return folder


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp(ODD_NAME)


@pytest.fixture(scope="module")
def report(source: Path, out: Path) -> dict:
    """The report that the first build printed, run as a process."""
    built = build(source, out)
    assert built.returncode == 0, built.stdout + built.stderr
    return json.loads(built.stdout)


def test_the_report_has_the_types_their_fields_and_constants(report: dict) -> None:
    assert report["built"]
    assert report["types"] == {
        "my_interfaces/srv/Ask": {
            "request": {"fields": {"target": "geometry_msgs/PointStamped"}, "constants": {}},
            "response": {
                "fields": {"error_code": "int32", "distance": "float64"},
                "constants": {"NO_WAY": {"type": "int32", "value": -31}},
            },
        },
        "my_interfaces/action/Go": {
            "goal": {"fields": {"distance": "float64"}, "constants": {}},
            "result": {
                "fields": {"error_code": "uint16"},
                "constants": {"NONE": {"type": "uint16", "value": 0}},
            },
            "feedback": {"fields": {"distance_remaining": "float64"}, "constants": {}},
        },
    }


def test_a_new_process_serves_calls_and_sends_goals_with_the_types(report: dict) -> None:
    library_path = (
        f"{report['environment']['LD_LIBRARY_PATH']}:{ros_environment().get('LD_LIBRARY_PATH', '')}"
    )
    used = run("-c", USE, PYTHONPATH=report["environment"]["PYTHONPATH"], LD_LIBRARY_PATH=library_path)
    assert used.stderr == ""
    assert used.stdout.splitlines() == [
        "my_interfaces.srv.Ask_Response(error_code=-31, distance=3.0)",
        "my_interfaces.action.Go_Result(error_code=7)",
    ]


@pytest.mark.usefixtures("report")
def test_a_running_process_takes_the_same_build_and_uses_it_at_once(source: Path, out: Path) -> None:
    used = run("-c", IMPORT_HERE + USE, source, out)
    assert used.stderr == ""
    assert used.stdout.splitlines()[:3] == [
        "False True",
        "True False",  # no library before the import: one of a build that is mended first would stay for ever
        "my_interfaces.srv.Ask_Response(error_code=-31, distance=3.0)",
    ]


def test_what_a_process_has_imported_is_not_replaced(
    source: Path, out: Path, report: dict, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = build_package(source, out, "my_interfaces")
    stranger = type(sys)("my_interfaces")
    stranger.__file__ = "/elsewhere/my_interfaces/__init__.py"
    monkeypatch.setitem(sys.modules, "my_interfaces", stranger)
    assert not package.is_importable_here()
    stranger.__file__ = str(package.prefix / "lib/my_interfaces/__init__.py")
    assert package.is_importable_here()


def test_the_newest_build_comes_first_and_alone_on_the_search_paths(
    source: Path, out: Path, report: dict
) -> None:
    package = build_package(source, out, "my_interfaces")
    earlier = f"{package.prefix}0/lib/python"
    path = package.variables({"PYTHONPATH": f"{earlier}:/mine"})["PYTHONPATH"]
    assert path.split(":") == [report["environment"]["PYTHONPATH"], "/mine"]


def test_a_wrong_definition_is_reported_without_a_build(tmp_path: Path) -> None:
    (tmp_path / "Go.srv").write_text("float speed\n---\n")
    refused = build(tmp_path, tmp_path / "out")
    assert refused.returncode == 1
    assert json.loads(refused.stdout) == {
        "package": "my_interfaces",
        "built": False,
        "problems": [
            {
                "file": "Go.srv",
                "line": 1,
                "text": "float speed",
                "wrong": "float is not a type of ROS 2",
                "expected": "float64",
            }
        ],
        "more": 0,
        "log": "",
    }
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("name", "wrong"), [("MyInterfaces", "cannot be the name"), ("std_msgs", "is installed")]
)
def test_a_package_needs_a_name_of_its_own(source: Path, tmp_path: Path, name: str, wrong: str) -> None:
    with pytest.raises(InvalidDefinitions, match=wrong):
        build_package(source, tmp_path, name)


def test_a_failed_build_of_valid_definitions_is_reported_with_its_output(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("the compiler said no")

    monkeypatch.setattr(cmake_package, "_run_cmake", fail)
    with pytest.raises(RuntimeError, match="the compiler said no"):
        build_package(source, tmp_path, "my_interfaces")
    assert list(tmp_path.iterdir()) == []
