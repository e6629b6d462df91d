"""The command line, and which `ros2` it executes."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from argparse import ArgumentParser
from pathlib import Path

import pytest

from ros_cli import app, real_ros2
from ros_cli.app import run
from ros_cli.verb import given_values
from ros_runtime.project import PROJECT

COURSE = Path(sys.executable).with_name("course")


@pytest.mark.parametrize(
    "words",
    [
        "topic list -t",
        "topic info -v /robot/odom",
        "topic type /robot/odom",
        "topic echo /robot/odom --once --field pose.pose",
        "topic hz /robot/odom",
        "topic pub /robot/cmd_vel geometry_msgs/msg/Twist {} --once",
        "topic pub -1 /robot/cmd_vel geometry_msgs/msg/Twist",
        "topic pub /robot/cmd_vel geometry_msgs/msg/Twist {} -r 10",
        "service list -t",
        "service type /robot/get_status",
        "service call /robot/get_status std_srvs/srv/Trigger",
        "action list -t",
        "action info /robot/walk_to",
        "action send_goal /robot/walk_to humanoid_interfaces/action/WalkTo {} --feedback",
        "action send_goal -f /robot/walk_to humanoid_interfaces/action/WalkTo",
        "node list",
        "node info /robot/humanoid",
        "param list",
        "param list /robot/arm",
        "param describe /robot/arm gain limits.low",
        "param get /robot/arm gain",
        "param set /robot/arm gain -0.5",
        "param dump /robot/arm",
        "param load /robot/arm arm.yaml",
        "interface show std_srvs/srv/SetBool",
        "interface list",
    ],
)
def test_the_verbs_and_flags_of_ros2cli_are_parsed(words: str) -> None:
    options = app.command_line("ros2").parse_args(words.split())
    assert options.run.__module__.startswith("ros_cli.verb")


# The flags of ros2cli 0.32.2 (Jazzy) and of later releases for Jazzy, without `-h` and positional arguments.
ALL = "--spin-time -s --use-sim-time --no-daemon"
QOS = (
    "--qos-profile --qos-depth --qos-history --qos-reliability --qos-durability --qos-liveliness "
    "--qos-liveliness-lease-duration-seconds"
)
ONE_NODE = f"{ALL} --include-hidden-nodes --timeout"
JAZZY = {
    "action info": "-t --show-types -c --count",
    "action list": "-t --show-types -c --count-actions",
    "action send_goal": "--stdin -f --feedback --timeout",
    "action type": "",
    "interface list": "-m --only-msgs -s --only-srvs -a --only-actions",
    "interface package": "",
    "interface packages": "",
    "interface proto": "",
    "interface show": "--all-comments --no-comments",
    "node info": f"{ALL} --include-hidden",
    "node list": f"{ALL} -a --all -c --count-nodes",
    "param delete": "",
    "param describe": ONE_NODE,
    "param dump": ONE_NODE,
    "param get": f"{ONE_NODE} --hide-type",
    "param list": f"{ALL} --filter --include-hidden-nodes --param-prefixes --param-type",
    "param load": f"{ONE_NODE} --no-use-wildcard",
    "param set": ONE_NODE,
    "service call": "--stdin -r --rate",
    "service echo": "",
    "service find": "",
    "service info": "",
    "service list": f"{ALL} -t --show-types -c --count-services --include-hidden-services",
    "service type": "",
    "topic bw": "",
    "topic delay": "",
    "topic echo": f"{ALL} {QOS} --csv --field --full-length -f --truncate-length -l --no-arr --no-str --flow-style "
    "--raw --no-lost-messages --filter --once --timeout --include-message-info -i",
    "topic find": "",
    "topic hz": "--spin-time -s --use-sim-time --window -w --filter --wall-time",
    "topic info": f"{ALL} --verbose -v",
    "topic list": f"{ALL} -t --show-types -c --count-topics --include-hidden-topics -v --verbose",
    "topic pub": f"--spin-time -s --use-sim-time {QOS} --stdin -r --rate -p --print -1 --once -t --times -w "
    "--wait-matching-subscriptions --max-wait-time-secs --keep-alive -n --node-name",
    "topic type": ALL,
}  # fmt: skip


def subcommands(parser: ArgumentParser) -> dict[str, ArgumentParser]:
    return {name: each for action in parser._actions for name, each in (action.choices or {}).items()}


@pytest.mark.parametrize("words", JAZZY)
def test_each_verb_and_flag_of_ros2cli_is_here_or_listed_as_missing(words: str) -> None:
    group, verb = words.split()
    verbs = subcommands(subcommands(app.command_line("ros2"))[group])
    page = (PROJECT / "docs/ros2_commands.md").read_text().partition("## What differs")[2]
    if verb not in verbs:
        assert re.search(rf"(?m)^  - verbs: .*`{words}`", page)
        return
    everywhere, here = (
        {
            flag
            for line in re.findall(rf"(?m)^  - {of}: (.*)$", page)
            for flag in re.findall(r"`(-[^` ]+)`", line)
        }
        for of in ("every verb", f"`{words}`")
    )
    known = set(verbs[verb]._option_string_actions)
    assert sorted(set(JAZZY[words].split()) - known - everywhere - here) == []
    assert sorted(known & here) == []


def test_values_may_come_from_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("{a: 1}"))
    options = app.command_line("ros2").parse_args(["service", "call", "/add", "a/srv/B", "--stdin"])
    assert given_values(options) == "{a: 1}"


def test_a_maximum_wait_without_a_number_of_subscriptions_is_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["topic", "pub", "/words", "std_msgs/msg/String", "{}", "--max-wait-time-secs", "1"]) == 1
    assert "is only effective with --wait-matching-subscriptions" in capsys.readouterr().err


def test_without_a_verb_the_help_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["topic"]) == 0
    shown = capsys.readouterr().out
    assert "usage: ros2 topic" in shown
    assert "ROS_DOMAIN_ID" in shown


def test_unusable_arguments_are_reported(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        run(["topic", "dance"])
    assert ended.value.code == 2
    shown = capsys.readouterr().err
    assert "usage: ros2 topic [-h] VERB ..." in shown
    assert "argument VERB: invalid choice: 'dance'" in shown


def test_an_error_is_reported_on_stderr(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["interface", "show", "no_msgs/msg/Nothing"]) == 1
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "Unknown package 'no_msgs'" in shown.err


@pytest.mark.parametrize(
    ("words", "error_text"),
    [
        (["service", "call", "/add", "std_srvs/srv/Nothing"], "The passed service type is invalid"),
        (
            ["service", "call", "/add", "std_msgs/msg/String"],
            "std_msgs/msg/String is of kind msg, not srv",
        ),
        (["topic", "pub", "/text", "String"], "expected a name such as geometry_msgs/msg/Twist"),
        (["action", "send_goal", "/walk", "std_srvs/srv/SetBool"], "The passed action type is invalid"),
    ],
)
def test_a_wrong_type_is_reported_before_waiting(
    words: list[str], error_text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(words) == 1
    assert error_text in capsys.readouterr().err


def test_the_launcher_has_the_same_commands() -> None:
    finished = subprocess.run(
        [COURSE, "ros", "interface", "show", "std_srvs/srv/SetBool"], capture_output=True, text=True
    )
    assert finished.returncode == 0, finished.stderr
    assert finished.stdout.splitlines()[0].startswith("bool data")


def test_its_help_names_the_ros_domain() -> None:
    finished = subprocess.run([COURSE, "ros", "--help"], capture_output=True, text=True)
    assert finished.returncode == 0
    assert "usage: course ros" in finished.stdout
    assert "ROS_DOMAIN_ID" in finished.stdout


def test_the_lab_finds_the_courses_ros2(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", real_ros2.path_with_ros2("/usr/bin:/bin"))
    finished = subprocess.run(["ros2", "service", "--help"], capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    assert "call" in finished.stdout


@pytest.mark.parametrize("wheels", [True, False])
def test_a_real_ros2_is_used_with_a_sourced_rclpy(
    wheels: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = tmp_path / "ros2"
    real.write_text("#!/bin/sh\n")
    real.chmod(0o755)
    monkeypatch.setenv("PATH", real_ros2.path_with_ros2(str(tmp_path)))
    monkeypatch.setattr(real_ros2, "uses_wheels", lambda: wheels)
    assert real_ros2.real_ros2() == (None if wheels else str(real))


def test_without_a_real_ros2_the_courses_is_used(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", real_ros2.path_with_ros2(str(tmp_path)))
    monkeypatch.setattr(real_ros2, "uses_wheels", lambda: False)
    assert real_ros2.real_ros2() is None


def test_the_command_is_executable_after_an_archive_has_lost_that(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "ros2").write_text("#!/bin/sh\n")
    monkeypatch.setattr(real_ros2, "OURS", tmp_path)
    assert real_ros2.path_with_ros2("/usr/bin") == f"{tmp_path}{os.pathsep}/usr/bin"
    assert os.access(tmp_path / "ros2", os.X_OK)
