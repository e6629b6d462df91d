"""The cells of chapter 2 show what its text says."""

from __future__ import annotations

import re

from execution import Executed, in_order
from gap_trials import GapTrials, Trial

CHAPTER = "02_services"


def test_the_first_server_tells_where_the_robot_walked(chapter: Executed) -> None:
    assert "success=True" in chapter.text("first-run")
    walked = re.search(r"x (-?[\d.]+) m", chapter.text("first-walk"))
    assert walked
    assert float(walked[1]) > 0.35
    drawn = chapter.html("first-draw")
    assert in_order(drawn, "notebook to where_am_i server", "where_am_i server to notebook: success True")


def test_the_ros2_commands_find_and_call_the_first_server(chapter: Executed) -> None:
    shown = chapter.text("types").replace("\r", "")  # `!` writes as to a terminal
    assert in_order(shown, "---\nbool success", "=====", "bool data", "---\nbool success")
    printed = chapter.text("ros2").replace("\r", "")
    assert in_order(
        printed,
        "/robot/where_am_i [std_srvs/srv/Trigger]\n",
        "\nstd_srvs/srv/Trigger\n",
        "Trigger_Response(success=True",
    )
    assert printed.count("\n/robot/where_am_i/") == 7
    assert printed.count("\n/sim/") == 5


def test_a_callback_that_returns_nothing_ends_the_node(chapter: Executed) -> None:
    printed = chapter.text("forget-run")
    assert in_order(printed, "no response within two seconds", "<am_i_ready.py: ended with exit status 1>")
    assert in_order(printed, "send_response", "raise TypeError()", "\nTypeError\n")


def test_an_exception_in_the_callback_ends_the_node(chapter: Executed) -> None:
    printed = chapter.text("m9-run")
    assert "no response within two seconds" in printed
    assert "<where_am_i.py: ended with exit status 1>" in printed
    assert "AttributeError: 'NoneType' object has no attribute" in printed


def test_the_fixed_server_answers_without_and_with_the_robot(chapter: Executed) -> None:
    assert in_order(
        chapter.text("m9-fix-run"), "without a robot:", "success=False", "with the robot:", "success=True"
    )


def test_marching_is_idempotent_and_refused_on_the_floor(chapter: Executed) -> None:
    printed = chapter.text("set-run")
    assert in_order(
        printed, "WALKING | once more: marching already", "stopped | once more: stopped already", "STANDING"
    )
    refused = "success=False, message='cannot march: the motors are off'", "<march.py: running>"
    assert in_order(chapter.text("set-refuse"), *refused)


def test_no_answer_says_nothing_about_the_request(chapter: Executed) -> None:
    slow, killed = chapter.text("lost-slow"), chapter.text("lost-kill")
    assert in_order(slow, "client: no response within one second", "test 1 is done")
    assert in_order(killed, "client: no response within one second", "test 1 begins", "exit status -9")
    assert "test 1 is done" not in killed


def test_a_dead_server_still_looks_ready(chapter: Executed) -> None:
    assert chapter.text("m8-run") == "ready: True\nNoAnswerError\n"


def test_a_synchronous_call_in_a_callback_deadlocks(chapter: Executed) -> None:
    printed = chapter.text("m4-run")
    assert in_order(
        printed, "no response from report", "<report.py: running>", "asking for the position", "directly: x"
    )
    assert "got it" not in printed


def test_half_of_the_calls_are_fast_and_the_slowest_is_not(chapter: Executed) -> None:
    half, slowest = map(float, re.findall(r"([\d.]+) ms", chapter.text("loops")))
    assert half < slowest


def test_a_movement_that_is_acknowledged_has_not_happened(chapter: Executed) -> None:
    at_the_success, later = (
        float(angle) for angle in re.findall(r"(-?[\d.]+) rad", chapter.text("acknowledged-run"))
    )
    assert at_the_success > -0.3
    assert later < -1.3


def test_walking_takes_more_power_than_standing(chapter: Executed) -> None:
    watts = [float(number) for number in re.findall(r"(\d+) W", chapter.text("battery-power"))]
    assert watts[1] > 2.2 * watts[0] > 60
    assert "times the power of standing" in chapter.text("battery-power")


def test_a_metre_costs_less_when_it_is_walked_fast(chapter: Executed) -> None:
    joules = [float(number) for number in re.findall(r"(\d+) J", chapter.text("battery-speeds"))]
    assert len(joules) == 3
    assert joules[0] > joules[-1]
    assert "Power against walking speed" in chapter.html("battery-speeds")


def test_the_rules_of_the_battery_are_in_its_definition(chapter: Executed) -> None:
    printed = chapter.text("battery")
    assert in_order(printed, "float32 current", "Negative when discharging", "percentage", "0 to 1 range")
    assert re.search(r"^temperature +nan$", printed, re.MULTILINE)


def test_nan_compares_false_with_everything(chapter: Executed) -> None:
    assert re.findall(r"True|False", chapter.text("nan")) == ["False", "False", "False", "True"]


def test_the_hurried_battery_misleads_in_both_directions(chapter: Executed) -> None:
    printed = chapter.text("battery-break-run")
    assert in_order(printed, "True 0.0 -> walk home", "a full battery:", "-> go on", "15.0 -> go on")


def test_the_careful_planner_catches_one_of_the_two_lies(chapter: Executed) -> None:
    assert in_order(chapter.text("planner-run"), "walk home", "stop and report")


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)
