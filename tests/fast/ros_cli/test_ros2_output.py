"""The output of the verbs, without a graph."""

from __future__ import annotations

from itertools import islice

import pytest
from geometry_msgs.msg import PoseStamped
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterType,
    ParameterValue,
)
from rclpy.parameter import get_parameter_value

from ros_cli.command_node import CommandNode, _Graph
from ros_cli.errors import CommandError, print_message, unknown
from ros_cli.verbs.interface import definition
from ros_cli.verbs.param import as_file, description_lines, value_line
from ros_cli.verbs.topic import ArrivalRate
from ros_cli.verbs.topic_echo import as_text, select
from ros_cli.verbs.topic_pub import ticks


def test_a_rate_is_printed_once_a_second() -> None:
    rate = ArrivalRate()
    printed = [rate.arrived(number * 100_000_000) for number in range(22)]
    assert [number for number, lines in enumerate(printed) if lines] == [11, 21]
    assert printed[11] == "average rate: 10.000\n\tmin: 0.100s max: 0.100s std dev: 0.00000s window: 11"


def test_old_intervals_leave_the_window() -> None:
    rate = ArrivalRate(window=1)
    printed = [rate.arrived(now) for now in (0, 1_000_000_000, 3_000_000_000)]
    assert printed == [
        None,
        None,
        "average rate: 0.500\n\tmin: 2.000s max: 2.000s std dev: 0.00000s window: 1",
    ]


def test_a_field_is_selected_by_its_path() -> None:
    assert as_text(select(PoseStamped(), "pose.orientation.w"), None) == "1.0\n"
    assert as_text(select(PoseStamped(), "pose.position"), None) == "x: 0.0\ny: 0.0\nz: 0.0\n"
    with pytest.raises(CommandError, match="no field 'heading'; the fields are position, orientation"):
        select(PoseStamped(), "pose.heading")
    with pytest.raises(CommandError, match="a plain value has no fields"):
        select(PoseStamped(), "header.frame_id.length")


@pytest.mark.parametrize(
    ("typed", "line"),
    [
        ("true", "Boolean value is: True"),
        ("3", "Integer value is: 3"),
        ("0.5", "Double value is: 0.5"),
        ("word", "String value is: word"),
        ("[1, 2]", "Integer values are: [1, 2]"),
        ("[0.5]", "Double values are: [0.5]"),
        ("[left, right]", "String values are: ['left', 'right']"),
    ],
)
def test_a_parameter_is_printed_with_its_type(typed: str, line: str) -> None:
    assert value_line(get_parameter_value(typed)) == line


def test_a_parameter_without_a_value_is_printed() -> None:
    assert value_line(ParameterValue()) == "Parameter not set."


def test_a_parameter_is_described_with_its_constraints() -> None:
    gain = ParameterDescriptor(
        name="gain",
        type=ParameterType.PARAMETER_DOUBLE,
        description="N·m/rad",
        floating_point_range=[FloatingPointRange(from_value=0.0, to_value=2.5)],
        additional_constraints="above the last one",
    )
    assert description_lines(gain).splitlines() == [
        "Parameter name: gain",
        "  Type: double",
        "  Description: N·m/rad",
        "  Constraints:",
        "    Min value: 0.0",
        "    Max value: 2.5",
        "    Additional constraints: above the last one",
    ]
    steps = ParameterDescriptor(
        name="steps",
        type=ParameterType.PARAMETER_INTEGER,
        read_only=True,
        integer_range=[IntegerRange(from_value=2, to_value=8, step=2)],
    )
    assert description_lines(steps).splitlines() == [
        "Parameter name: steps",
        "  Type: integer",
        "  Constraints:",
        "    Read only: true",
        "    Min value: 2",
        "    Max value: 8",
        "    Step: 2",
    ]


def test_parameters_are_dumped_as_a_parameter_file() -> None:
    assert as_file("/robot/arm", {"gain": 1.5, "limits.low": 1, "limits.high": 2}) == (
        "/robot/arm:\n  ros__parameters:\n    gain: 1.5\n    limits:\n      high: 2\n      low: 1\n"
    )


def test_a_definition_is_shown_with_its_comments_and_the_fields_of_its_types() -> None:
    shown = list(definition("geometry_msgs/msg/PoseStamped"))
    assert shown[:8] == [
        "# A Pose with reference coordinate frame and timestamp",
        "",
        "std_msgs/Header header",
        "\tbuiltin_interfaces/Time stamp",
        "\t\tint32 sec",
        "\t\tuint32 nanosec",
        "\tstring frame_id",
        "Pose pose",
    ]
    assert shown[8:10] == ["\tPoint position", "\t\tfloat64 x"]


def test_comments_can_be_left_out_and_those_of_nested_types_shown() -> None:
    assert list(definition("std_srvs/srv/SetBool", comments=False)) == [
        *("bool data", "---", "bool success", "string message")
    ]
    assert any(
        "#" in line
        for line in definition("geometry_msgs/msg/PoseStamped", nested_comments=True)
        if "\t" in line
    )


def test_an_action_of_the_course_is_shown_whole() -> None:
    shown = list(definition("humanoid_interfaces/action/WalkTo"))
    assert shown.count("---") == 2
    assert "\tstd_msgs/Header header" in shown


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("SetBool", "Expected three parts separated by '/'"),
        ("no_msgs/msg/Nothing", "Unknown package 'no_msgs'"),
        ("std_srvs/srv/Nothing", "Could not find the interface 'std_srvs/srv/Nothing'"),
    ],
)
def test_an_unknown_interface_is_reported(name: str, expected: str) -> None:
    with pytest.raises(CommandError, match=expected):
        list(definition(name))


def test_an_unknown_name_is_reported_with_similar_names() -> None:
    names = ["/robot/odom", "/robot/imu"]
    assert str(unknown("topic", "/odom", names)) == "Unknown topic '/odom': did you mean /robot/odom?"
    assert "`topic list` shows" in str(unknown("topic", "/camera", names))


def test_only_near_names_are_suggested() -> None:
    names = ["/robot/odom", "/robot/imu", "/robot/l_gripper/wrench", "/robot/r_gripper/wrench", "/rosout"]
    assert str(unknown("topic", "/robot/odmo", names)).endswith("did you mean /robot/odom?")
    assert str(unknown("topic", "/robt/odmo", names)).endswith("did you mean /robot/odom?")
    assert str(unknown("topic", "/r_gripper/wrench", names)).endswith(
        "did you mean /robot/l_gripper/wrench or /robot/r_gripper/wrench?"
    )
    assert str(unknown("topic", "/robot/bat", [*names, "/robot/battery_state"])).endswith(
        "/robot/battery_state?"
    )
    assert "did you mean" not in str(unknown("topic", "/robot/camera", names))


def test_a_message_is_broken_between_words_in_a_terminal_only(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", "30")
    print_message("Unknown topic '/robot/odmo': did you mean /robot/odom?\nnext")
    assert capsys.readouterr().err == "Unknown topic '/robot/odmo': did you mean /robot/odom?\nnext\n"
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    print_message("Unknown topic '/robot/odmo': did you mean /robot/odom?\nnext")
    assert capsys.readouterr().err == "Unknown topic '/robot/odmo':\ndid you mean /robot/odom?\nnext\n"


class _OneTopic(CommandNode):
    """A command node whose graph has another node and one topic."""

    def __init__(self, spin_time: float) -> None:
        self._spin_time = spin_time

    def _graph(self) -> _Graph:
        return _Graph(["humanoid", "_ros2cli_1"], ["/robot/odom"], [])

    def _has_nameless_endpoints(self) -> bool:
        return False


@pytest.mark.parametrize(("topic", "told"), [("/robot/odom", ""), ("/robot/odmo", "looking for it …\n")])
def test_a_missing_name_is_looked_for_a_while_and_that_is_said(
    topic: str, told: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = [0.0]
    monkeypatch.setattr("ros_cli.command_node.time.monotonic", lambda: clock[0])
    monkeypatch.setattr(
        "ros_cli.command_node.time.sleep", lambda seconds: clock.__setitem__(0, clock[0] + seconds)
    )
    _OneTopic(spin_time=1.0).discover(lambda: topic == "/robot/odom", "it")
    assert clock[0] == pytest.approx(3.0 if told else 1.0, abs=0.05)
    assert capsys.readouterr().err == told


def test_ticks_end_after_a_given_number_or_never() -> None:
    assert list(ticks(0.001, 3)) == [1, 2, 3]
    assert list(islice(ticks(0.001, 0), 5)) == [1, 2, 3, 4, 5]
