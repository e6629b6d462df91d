"""The cells of chapter 1 show what its text says."""

from __future__ import annotations

import re

import pytest
from execution import Executed, in_order, number
from gap_trials import GapTrials, Trial

CHAPTER = "01_robot_and_graph"


def test_the_first_command_walks_ten_steps(chapter: Executed) -> None:
    assert number(r"x (-?[\d.]+) m", chapter.text("first-walk")) > 0.3


def test_ros2_lists_the_robot_and_the_notebook(chapter: Executed) -> None:
    assert chapter.text("ros2-nodes").split() == ["/robot/humanoid", "/robot/notebook"]
    topics = chapter.text("ros2-topics").splitlines()
    assert "/robot/cmd_vel [geometry_msgs/msg/Twist]" in topics
    assert "/robot/odom [nav_msgs/msg/Odometry]" in topics


def test_ros2_shows_a_type_and_both_ends_of_its_topic(chapter: Executed) -> None:
    assert in_order(
        chapter.text("ros2-interface"),
        *("linear", "float64 x", "angular", "Type: geometry_msgs/msg/Twist"),
        *("Publisher count: 1", "Node name: notebook", "QoS profile"),
        *("Subscription count: 1", "Node name: humanoid"),
    )


def test_ros2_reads_a_message_and_measures_its_rate(chapter: Executed) -> None:
    assert in_order(chapter.text("ros2-echo"), "position:", "x: ", "orientation:", "w: ")
    assert number(r"average rate: ([\d.]+)", chapter.text("ros2-hz")) == pytest.approx(20, abs=4)


def test_one_message_from_ros2_moves_the_robot_a_step(chapter: Executed) -> None:
    printed = chapter.text("ros2-pub")
    assert "publishing #1: geometry_msgs.msg.Twist(linear=geometry_msgs.msg.Vector3(x=0.3" in printed
    before, after = (number(rf"{when}: +x (-?[\d.]+) m", printed) for when in ("before", "after"))
    assert 0.02 < after - before < 0.35


def test_the_graph_has_the_robot_and_the_notebook(chapter: Executed) -> None:
    assert chapter.text("graph") == "['/robot/humanoid', '/robot/notebook']\n"
    drawn = chapter.html("graph")
    assert "/robot/odom: from /robot/humanoid to /robot/notebook." in drawn
    assert "/robot/cmd_vel: from /robot/notebook to /robot/humanoid." in drawn


def test_the_first_node_prints_where_the_robot_walks(chapter: Executed) -> None:
    walked = [float(x) for x in re.findall(r"^x (-?[\d.]+) m", chapter.text("listen-run"), re.MULTILINE)]
    assert len(walked) >= 3
    assert walked == sorted(walked)
    assert walked[-1] > walked[0] + 0.3, chapter.text("listen-run")
    assert "/robot/odom: from /robot/humanoid to /robot/first_node, /robot/notebook." in chapter.html(
        "listen-run"
    )


def test_a_reliable_subscription_gets_no_best_effort_sensor_and_the_log_says_so(chapter: Executed) -> None:
    printed = chapter.text("qos-run")
    for topic in ("imu", "joint_states"):
        assert re.search(f"topic '{topic}', offering incompatible QoS", printed)
    assert "received: battery_state, odom, robot_state\n" in printed
    assert "/robot/imu: from /robot/humanoid to /robot/monitor (which receives nothing)." in chapter.html(
        "qos-run"
    )


def test_ros2_shows_what_is_offered_and_what_is_requested(chapter: Executed) -> None:
    assert in_order(
        chapter.text("qos-info"),
        *("Node name: humanoid", "PUBLISHER", "BEST_EFFORT"),
        *("Node name: monitor", "SUBSCRIPTION", "RELIABLE"),
    )


def test_the_solutions_of_the_gaps_are_accepted(chapter: Executed) -> None:
    assert (
        chapter.text("qos-fix-file")
        == "✓ monitor_fixed.py: messages arrived on battery_state, imu, joint_states, odom, robot_state\n"
    )
    assert (
        "✓ robot_mode.py: it received the last state although the simulation was paused: 'mode 1, motors on"
        in chapter.text("mode-file")
    )
    assert 0.9 < number(r"walked ([\d.]+) m", chapter.text("metre-file")) < 1.5


def test_the_left_arm_is_raised_and_read_by_name(chapter: Executed) -> None:
    pitches = re.findall(r"l_shoulder_pitch (-?[\d.]+) rad", chapter.text("joints-run"))
    assert float(pitches[0]) > 0 > -2 > float(pitches[-1])


def test_only_the_transient_local_subscription_gets_what_was_published_before(chapter: Executed) -> None:
    paused, _, running = chapter.text("late-run").partition("running again:")
    assert in_order(paused, "paused:", "transient local: 0.9")
    assert "plain:" not in paused
    assert "plain:           0.9" in running


def test_the_robot_stops_by_itself_when_its_commander_is_killed(chapter: Executed) -> None:
    assert "WALKING" in chapter.text("walk-run")
    printed = chapter.text("watchdog")
    assert 0.4 < number(r"STANDING after ([\d.]+) s", printed) < 5.0
    assert 0.1 < number(r"and ([\d.]+) m", printed) < 0.6


def test_one_message_is_a_twitch_and_a_stream_is_a_walk(chapter: Executed) -> None:
    printed = chapter.text("once")
    assert 0.02 < number(r"one message: +([\d.]+) m", printed) < 0.35
    assert number(r"ten a second: ([\d.]+) m", printed) >= 0.5


def test_a_speed_beyond_the_limit_is_walked_at_the_limit(chapter: Executed) -> None:
    assert number(r"([\d.]+) m/s", chapter.text("limits")) == pytest.approx(0.4, abs=0.06)


def test_without_torque_the_walking_robot_falls(chapter: Executed) -> None:
    printed = chapter.text("fall")
    assert 0.2 < number(r"after ([\d.]+) s", printed) < 2.0
    assert "FALLEN | motors enabled: False" in printed
    assert "a stone" in chapter.html("fall-plot")
    assert "image/webp" in chapter.html("fall-film")


def test_forward_is_where_the_robot_looks(chapter: Executed) -> None:
    turned, walked = chapter.text("frames").split("turned:")[1].split("walked:")
    assert 70 < number(r"heading (-?\d+)°", turned) < 110
    x, y = (number(f"{axis} (-?[\\d.]+) m", walked) for axis in "xy")
    assert y > 0.4 > 0.25 > abs(x)
    assert "frames: odom -> base_link" in walked


def test_a_quaternion_in_the_wrong_order_lays_the_robot_down(chapter: Executed) -> None:
    printed = chapter.text("quaternion")
    assert abs(number(r"as it comes: .* z (-?[\d.]+)", printed)) < 0.5
    assert number(r"w first: .* z (-?[\d.]+)", printed) > 0.98


def test_a_slash_in_front_makes_another_topic(chapter: Executed) -> None:
    assert in_order(
        chapter.text("names-run"), "odom: 20 | /odom: 0", "Publisher count: 0", "Subscription count: 1"
    )
    assert "/odom: from nobody to /robot/slash." in chapter.html("names-run")


def test_the_pattern_questions_begin_with_the_cancel(chapter: Executed) -> None:
    assert "Question 1. Cancel: " in str(chapter.notebook.metadata.widgets)


def test_an_int_in_a_float_field_moves_nothing_or_is_refused(chapter: Executed) -> None:
    unchecked, checked, fixed = chapter.text("fields").strip().splitlines()
    walked_nothing = number(r"walked ([\d.]+) m", unchecked) < 0.05 and "STANDING" in unchecked
    assert walked_nothing or "exit status -6" in unchecked  # rclpy compiled with assertions ends the process
    assert "AssertionError: The 'x' field must be of type 'float'" in checked
    assert number(r"walked ([\d.]+) m", fixed) > 0.1


@pytest.fixture(scope="module")
def gaps(gaps: GapTrials) -> GapTrials:
    """The robot runs, as after the chapter's first cell."""
    gaps.run("lab.start_robot()")
    return gaps


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)
