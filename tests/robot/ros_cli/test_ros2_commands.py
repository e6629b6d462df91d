"""The ros2 commands, typed in a shell beside a running node: their words, their output, their exit status."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ros_cli.real_ros2 import OURS
from ros_runtime.environment import ros_environment
from ros_runtime.ros_domain import ReservedDomain, loopback_variables

PLAYGROUND = Path(__file__).with_name("playground.py")
TIMEOUT = 60.0  # s, for a busy machine
WALK = "humanoid_interfaces/action/WalkTo"
ADD = "humanoid_interfaces/srv/AddTwoInts"
TWIST = "geometry_msgs/msg/Twist"
POSE = "geometry_msgs/msg/PoseStamped"

Ros2 = Any  # a function: the words of a command → its outcome


@pytest.fixture(scope="module")
def environment() -> Iterator[dict[str, str]]:
    """A shell in a ROS domain of its own."""
    domain = ReservedDomain()
    yield {
        **os.environ,
        **ros_environment(),
        **loopback_variables(),
        "ROS_DOMAIN_ID": str(domain.domain_id),
    }
    domain.release()


@pytest.fixture(scope="module")
def playground(environment: dict[str, str]) -> Iterator[subprocess.Popen[str]]:
    command = [sys.executable, str(PLAYGROUND)]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as node:
        assert node.stdout
        assert node.stdout.readline() == "ready\n"
        yield node
        node.send_signal(signal.SIGINT)
        node.wait(TIMEOUT)


@pytest.fixture(scope="module")
def ros2(environment: dict[str, str], playground: subprocess.Popen[str]) -> Ros2:
    def finished(*words: str) -> subprocess.CompletedProcess[str]:
        command = [OURS / "ros2", *words]
        run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=TIMEOUT)
        run.stderr = re.sub(r"^looking for .*\n", "", run.stderr)  # if discovery takes long on a busy machine
        return run

    return finished


@pytest.fixture
def started(environment: dict[str, str], playground: subprocess.Popen[str]) -> Iterator[Any]:
    """A function that starts a command that runs until Ctrl-C."""
    running: list[subprocess.Popen[str]] = []

    def start(*words: str) -> subprocess.Popen[str]:
        command = [OURS / "ros2", *words]
        running.append(
            subprocess.Popen(
                command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
            )
        )
        return running[-1]

    yield start
    for each in running:
        each.kill()
        each.communicate()


def press_ctrl_c(process: subprocess.Popen[str]) -> tuple[int, str]:
    """Return exit status and the rest of the output."""
    process.send_signal(signal.SIGINT)
    rest, _ = process.communicate(timeout=TIMEOUT)
    return process.returncode, rest


@pytest.mark.parametrize(
    ("words", "output"),
    [
        ("topic type /demo/chatter", "std_msgs/msg/String\n"),
        (
            "topic info /demo/chatter",
            "Type: std_msgs/msg/String\nPublisher count: 1\nSubscription count: 0\n",
        ),
        ("topic echo /demo/chatter --once", "data: hello\n---\n"),
        ("topic echo /demo/chatter --once --field data", "hello\n---\n"),
        ("topic echo /demo/power --once", "data: true\n---\n"),
        ("service type /demo/add", f"{ADD}\n"),
        ("node list --spin-time 2", "/demo/playground\n"),
        ("action list -t --spin-time 2", f"/demo/walk_to [{WALK}]\n"),
        (
            "action info /demo/walk_to",
            "Action: /demo/walk_to\nAction clients: 0\nAction servers: 1\n    /demo/playground\n",
        ),
        ("param get /demo/playground gain", "Double value is: 1.5\n"),
        (
            "param describe /demo/playground gain limits.low",
            "Parameter name: gain\n  Type: double\n  Constraints:\n"
            "Parameter name: limits.low\n  Type: integer\n  Constraints:\n",
        ),
        (
            "param dump /demo/playground",
            "/demo/playground:\n  ros__parameters:\n    gain: 1.5\n    limits:\n      low: 2\n"
            "    start_type_description_service: true\n    use_sim_time: false\n\n",
        ),
        (
            "param list --spin-time 2",
            "/demo/playground:\n  gain\n  limits.low\n  start_type_description_service\n  use_sim_time\n",
        ),
    ],
)
def test_it_prints_what_ros2cli_prints(ros2: Ros2, words: str, output: str) -> None:
    finished = ros2(*words.split())
    assert (finished.stdout, finished.stderr, finished.returncode) == (output, "", 0)


def test_topics_and_services_are_listed_with_their_types(ros2: Ros2) -> None:
    topics = ros2("topic", "list", "-t", "--spin-time", "2").stdout.splitlines()
    assert topics == [
        "/demo/chatter [std_msgs/msg/String]",
        f"/demo/cmd_vel [{TWIST}]",
        "/demo/power [std_msgs/msg/Bool]",
        "/parameter_events [rcl_interfaces/msg/ParameterEvent]",
        "/rosout [rcl_interfaces/msg/Log]",
    ]
    services = ros2("service", "list", "-t", "--spin-time", "2").stdout.splitlines()
    assert f"/demo/add [{ADD}]" in services
    assert not any("_action" in line for line in services)
    assert ros2("topic", "list", "--spin-time", "2").stdout.splitlines() == [
        line.split()[0] for line in topics
    ]


def test_the_details_of_a_topic_name_its_nodes_and_qos(ros2: Ros2) -> None:
    shown = ros2("topic", "info", "-v", "/demo/power").stdout
    assert shown.startswith("Type: std_msgs/msg/Bool\n\nPublisher count: 1\n\nNode name: playground\n")
    assert "  Durability: TRANSIENT_LOCAL\n" in shown
    assert shown.endswith("\n\nSubscription count: 0\n\n")


def test_a_node_is_printed_with_all_its_endpoints(ros2: Ros2) -> None:
    lines = ros2("node", "info", "/demo/playground").stdout.splitlines()
    assert lines[0] == "/demo/playground"
    assert [line for line in lines if re.fullmatch(r"  \S.*:", line)] == [
        *("  Subscribers:", "  Publishers:", "  Service Servers:", "  Service Clients:"),
        *("  Action Servers:", "  Action Clients:"),
    ]
    assert lines.index("  Subscribers:") < lines.index(f"    /demo/cmd_vel: {TWIST}")
    assert lines.index("  Action Servers:") < lines.index(f"    /demo/walk_to: {WALK}")


def test_a_service_is_called(ros2: Ros2) -> None:
    finished = ros2("service", "call", "/demo/add", ADD, "{a: 2, b: 3}")
    assert finished.returncode == 0, finished.stderr
    assert finished.stdout.removeprefix("waiting for service to become available...\n") == (
        "requester: making request: humanoid_interfaces.srv.AddTwoInts_Request(a=2, b=3)\n\n"
        "response:\nhumanoid_interfaces.srv.AddTwoInts_Response(sum=5)\n\n"
    )


def test_a_goal_is_sent_and_its_feedback_and_result_are_printed(ros2: Ros2) -> None:
    finished = ros2("action", "send_goal", "/demo/walk_to", WALK, "{max_velocity: 0.5}", "--feedback")
    assert finished.returncode == 0, finished.stderr
    lines = finished.stdout.splitlines()
    assert lines[:3] == [
        "Waiting for an action server to become available...",
        "Sending goal:",
        "     target_pose:",
    ]
    assert any(re.fullmatch(r"Goal accepted with ID: [0-9a-f]{32}", line) for line in lines)
    assert "Feedback:" in lines
    assert lines[lines.index("Result:") + 1] == "    error_code: 0"
    assert "total_steps: 3" in lines
    assert lines[-1] == "Goal finished with status: SUCCEEDED"


def test_a_rejected_goal_is_printed(ros2: Ros2) -> None:
    finished = ros2("action", "send_goal", "/demo/walk_to", WALK, "{max_velocity: -1.0}")
    assert finished.returncode == 0
    assert finished.stdout.splitlines()[-1] == "Goal was rejected."


def test_ctrl_c_cancels_a_goal_and_its_end_is_printed(
    started: Any, playground: subprocess.Popen[str]
) -> None:
    sending = started("action", "send_goal", "-f", "/demo/walk_to", WALK, "{max_velocity: 2.0}")
    for line in sending.stdout:
        if line == "Feedback:\n":
            break
    status, rest = press_ctrl_c(sending)
    assert re.findall(r"^.*cancel.*$|^Result:$", rest, re.IGNORECASE | re.MULTILINE) == [
        *("Canceling goal...", "Goal canceled.", "Result:", "Goal finished with status: CANCELED")
    ]
    assert status == 0
    assert playground.stdout
    assert playground.stdout.readline() == "goal canceled\n"


def test_a_rate_is_printed_until_ctrl_c(started: Any) -> None:
    measuring = started("topic", "hz", "/demo/chatter")
    first = measuring.stdout.readline()
    if first.startswith("looking for"):  # on a busy machine
        first = measuring.stdout.readline()
    second = measuring.stdout.readline()
    assert re.fullmatch(r"average rate: \d+\.\d{3}\n", first)
    assert re.fullmatch(r"\tmin: \S+s max: \S+s std dev: \S+s window: \d+\n", second)
    assert press_ctrl_c(measuring)[0] == signal.SIGINT


def test_a_message_is_published_once_and_arrives(ros2: Ros2, playground: subprocess.Popen[str]) -> None:
    finished = ros2("topic", "pub", "--once", "/demo/cmd_vel", TWIST, "{linear: {x: 0.25}}")
    assert finished.returncode == 0, finished.stderr
    assert re.match(
        r"(Waiting for at least 1 matching subscription\(s\)\.\.\.\n)*publisher: beginning loop\n"
        r"publishing #1: geometry_msgs\.msg\.Twist\(linear=geometry_msgs\.msg\.Vector3\(x=0\.25,",
        finished.stdout,
    )
    assert playground.stdout
    assert playground.stdout.readline() == "cmd_vel 0.25\n"


def test_auto_is_the_time_of_sending(ros2: Ros2) -> None:
    goal = "{max_velocity: -1.0, target_pose: {header: auto}}"
    finished = ros2("action", "send_goal", "/demo/walk_to", WALK, goal)
    assert int(re.findall(r"sec: (\d+)", finished.stdout)[0]) > 1_700_000_000, finished.stderr
    finished = ros2("topic", "pub", "-t", "1", "-w", "0", "/demo/pose", POSE, "{header: {stamp: now}}")
    assert int(re.findall(r"sec=(\d+)", finished.stdout)[0]) > 1_700_000_000, finished.stderr


def test_echo_ends_after_its_timeout_also_while_messages_come(ros2: Ros2) -> None:
    finished = ros2("topic", "echo", "/demo/chatter", "--timeout", "1")
    assert finished.returncode == 0
    assert finished.stdout.startswith("data: hello\n---\n")


def test_messages_are_published_at_a_rate(started: Any) -> None:
    publishing = started("topic", "pub", "/demo/words", "std_msgs/msg/String", "data: hi", "-r", "20")
    lines = [publishing.stdout.readline() for _ in range(6)]
    assert lines[0] == "publisher: beginning loop\n"
    assert lines[1::2] == [f"publishing #{number}: std_msgs.msg.String(data='hi')\n" for number in (1, 2, 3)]
    assert press_ctrl_c(publishing)[0] == signal.SIGINT


def test_a_parameter_is_set_refused_dumped_and_loaded(ros2: Ros2, tmp_path: Path) -> None:
    before = tmp_path / "before.yaml"
    before.write_text(ros2("param", "dump", "/demo/playground").stdout)

    assert ros2("param", "set", "/demo/playground", "gain", "2.5").stdout == "Set parameter successful\n"
    assert ros2("param", "get", "/demo/playground", "gain").stdout == "Double value is: 2.5\n"
    refused = ros2("param", "set", "/demo/playground", "gain", "-1.0")
    assert (refused.stderr, refused.returncode) == ("Setting parameter failed: gain is positive\n", 0)

    loaded = ros2("param", "load", "/demo/playground", str(before))
    assert "Set parameter gain successful\n" in loaded.stdout
    assert ros2("param", "get", "/demo/playground", "gain").stdout == "Double value is: 1.5\n"


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("topic info /chatter", "Unknown topic '/chatter': did you mean /demo/chatter?"),
        ("topic echo /demo/nothing", "Could not determine the type for the passed topic"),
        ("service type /add", "Unknown service '/add': did you mean /demo/add?"),
        ("service call /demo/add std_srvs/srv/Trigger", f"has the type {ADD}, not std_srvs/srv/Trigger"),
        (
            "action send_goal /demo/walk_to humanoid_interfaces/action/StandUp",
            f"has the type {WALK}, not humanoid_interfaces/action/StandUp",
        ),
        ("node info /playground", "Unknown node '/playground': did you mean /demo/playground?"),
        ("param get /demo/nobody gain", "Node not found"),
        ("param get /demo/playground strength", "Parameter not set"),
        ("param describe /demo/playground gain strength", "Not all of gain, strength are declared"),
        ("param load /demo/playground missing.yaml", "missing.yaml cannot be loaded"),
    ],
)
def test_a_failed_command_is_reported_with_exit_status_1(ros2: Ros2, words: str, expected: str) -> None:
    finished = ros2(*words.split())
    assert finished.returncode == 1
    assert expected in finished.stderr


def test_a_list_in_an_empty_domain_says_where_the_nodes_of_a_notebook_are(
    environment: dict[str, str],
) -> None:
    with ReservedDomain() as domain_id:
        empty = environment | {"ROS_DOMAIN_ID": str(domain_id)}
        run = subprocess.run(
            [OURS / "ros2", "node", "list"], env=empty, capture_output=True, text=True, timeout=TIMEOUT
        )
    assert run.stdout == ""
    assert run.stderr.startswith(f"No node was found in ROS domain {domain_id}.")
    assert "type this in a terminal of JupyterLab" in run.stderr
