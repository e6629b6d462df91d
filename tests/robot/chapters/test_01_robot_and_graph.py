"""Chapter 1 shows what it says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed("01_robot_and_graph")


def number(text: str, pattern: str) -> float:
    """The number in a text where the pattern has its group."""
    found = re.search(pattern, text)
    assert found, f"{pattern!r} is not in {text!r}"
    return float(found[1])


def test_the_first_command_walks_ten_steps(chapter: Executed) -> None:
    assert number(chapter.text("first-walk"), r"x (-?[\d.]+) m") > 0.3


def test_the_graph_has_the_robot_and_the_notebook(chapter: Executed) -> None:
    assert chapter.text("graph") == "['/robot/humanoid', '/robot/notebook']\n"
    drawn = chapter.html("graph")
    assert "/robot/odom: from /robot/humanoid to /robot/notebook." in drawn
    assert "/robot/cmd_vel: from /robot/notebook to /robot/humanoid." in drawn


def test_the_types_have_their_fields(chapter: Executed) -> None:
    assert in_order(
        chapter.text("types"), "Twist", "geometry_msgs/Vector3", "Vector3", "x ", "double", "Odometry"
    )


def test_the_first_node_hears_where_the_robot_walks(chapter: Executed) -> None:
    walked = [float(x) for x in re.findall(r"^x (-?[\d.]+) m", chapter.text("listen-run"), re.MULTILINE)]
    assert len(walked) >= 3
    assert walked == sorted(walked)
    assert walked[-1] > walked[0] + 0.3, chapter.text("listen-run")
    assert "/robot/odom: from /robot/humanoid to /robot/listen, /robot/notebook." in chapter.html(
        "listen-run"
    )


def test_a_reliable_subscriber_hears_no_sensor_and_the_log_says_so(chapter: Executed) -> None:
    printed = chapter.text("senses-run")
    for topic in ("imu", "joint_states"):
        assert re.search(f"topic '{topic}', offering incompatible QoS", printed)
    assert "heard: battery_state, odom, robot_state\n" in printed
    assert in_order(printed, "/robot/imu", "to   /robot/senses: reliable", "which offers only best effort")
    assert "/robot/imu: from /robot/humanoid to /robot/senses (which receives nothing)." in chapter.html(
        "senses-run"
    )


def test_a_subscriber_that_asks_for_less_hears_all_five(chapter: Executed) -> None:
    assert chapter.text("senses-fix-run") == "heard: battery_state, imu, joint_states, odom, robot_state\n\n"


def test_the_left_arm_is_raised_and_read_by_name(chapter: Executed) -> None:
    pitches = re.findall(r"l_shoulder_pitch (-?[\d.]+) rad", chapter.text("joints-run"))
    assert float(pitches[0]) > 0 > -2 > float(pitches[-1])


def test_only_the_transient_local_subscription_hears_what_was_said_before(chapter: Executed) -> None:
    still, _, on = chapter.text("late-run").partition("the world goes on")
    assert in_order(still, "the world stands still", "transient local: 0.9")
    assert "plain:" not in still
    assert "plain:           0.9" in on


def test_the_robot_stops_by_itself_when_its_commander_is_killed(chapter: Executed) -> None:
    assert "WALKING" in chapter.text("walk-run")
    printed = chapter.text("watchdog")
    assert 0.4 < number(printed, r"STANDING after ([\d.]+) s") < 5.0
    assert 0.1 < number(printed, r"and ([\d.]+) m") < 0.6


def test_one_message_is_a_twitch_and_a_stream_is_a_walk(chapter: Executed) -> None:
    printed = chapter.text("once")
    assert 0.02 < number(printed, r"one message: +([\d.]+) m") < 0.35
    assert number(printed, r"ten a second: ([\d.]+) m") >= 0.5


def test_a_speed_beyond_the_limit_is_walked_at_the_limit(chapter: Executed) -> None:
    assert number(chapter.text("limits"), r"([\d.]+) m/s") == pytest.approx(0.4, abs=0.06)


def test_without_torque_the_walking_robot_falls(chapter: Executed) -> None:
    printed = chapter.text("fall")
    assert 0.2 < number(printed, r"after ([\d.]+) s") < 2.0
    assert "FALLEN | motors enabled: False" in printed


def test_forward_is_where_the_robot_looks(chapter: Executed) -> None:
    turned, walked = chapter.text("frames").split("turned:")[1].split("walked:")
    assert 70 < number(turned, r"heading (-?\d+)°") < 110
    x, y = (number(walked, f"{axis} (-?[\\d.]+) m") for axis in "xy")
    assert y > 0.4 > 0.25 > abs(x)
    assert "frames: odom -> base_link" in walked


def test_a_quaternion_in_the_wrong_order_lays_the_robot_down(chapter: Executed) -> None:
    printed = chapter.text("quaternion")
    assert abs(number(printed, r"as it comes: .* z (-?[\d.]+)")) < 0.5
    assert number(printed, r"w first: .* z (-?[\d.]+)") > 0.98


def test_a_slash_in_front_makes_another_topic(chapter: Executed) -> None:
    assert "odom: 20 | /odom: 0" in chapter.text("names-run")
    assert "/odom: from nobody to /robot/slash." in chapter.html("names-run")


def test_an_int_in_a_float_field_moves_nothing_or_is_refused(chapter: Executed) -> None:
    unchecked, checked, fixed = chapter.text("fields").strip().splitlines()
    walked_nothing = number(unchecked, r"walked ([\d.]+) m") < 0.05 and "STANDING" in unchecked
    assert walked_nothing or "exit status -6" in unchecked  # rclpy compiled with assertions ends the process
    assert "AssertionError: The 'x' field must be of type 'float'" in checked
    assert number(fixed, r"walked ([\d.]+) m") > 0.1
