"""Chapter 2 shows what it says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order
from gap_trials import GapTrials

CHAPTER = "02_services"


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed(CHAPTER)


def test_the_first_server_tells_where_the_robot_walked(chapter: Executed) -> None:
    assert "success=True" in chapter.text("first-run")
    walked = re.search(r"x (-?[\d.]+) m", chapter.text("first-walk"))
    assert walked
    assert float(walked[1]) > 0.35
    drawn = chapter.html("first-draw")
    assert in_order(drawn, "notebook to where_am_i server", "where_am_i server to notebook: success True")


def test_an_exception_in_the_callback_ends_the_node(chapter: Executed) -> None:
    printed = chapter.text("m9-run")
    assert "no answer within two seconds" in printed
    assert "<where_am_i.py: ended with exit status 1>" in printed
    assert "AttributeError: 'NoneType' object has no attribute" in printed


def test_the_fixed_server_answers_without_and_with_the_robot(chapter: Executed) -> None:
    assert in_order(
        chapter.text("m9-fix-run"), "without a robot:", "success=False", "with the robot:", "success=True"
    )


def test_a_field_of_a_wrong_type_is_garbage_or_an_error(chapter: Executed) -> None:
    printed = chapter.text("fields")
    is_garbage = in_order(printed, "success=1 arrives as False", "x=1 arrives as 5e-324")
    assert is_garbage or "Assertion" in printed.split("CHECK_FIELDS='1'")[0]  # rclpy of apt ends the process
    assert in_order(printed, "CHECK_FIELDS='1'", "AssertionError: The 'success' field must be of type 'bool'")


def test_marching_is_idempotent_and_refused_on_the_floor(chapter: Executed) -> None:
    printed = chapter.text("set-run")
    assert in_order(
        printed, "WALKING | once more: marching already", "standing | once more: standing already", "STANDING"
    )
    assert "success=False, message='cannot march: the motors are off'" in chapter.text("set-refuse")


def test_no_answer_says_nothing_about_the_request(chapter: Executed) -> None:
    slow, killed = chapter.text("lost-slow"), chapter.text("lost-kill")
    assert in_order(slow, "client: no answer within one second", "test 1 is done")
    assert in_order(killed, "client: no answer within one second", "test 1 begins", "exit status -9")
    assert "test 1 is done" not in killed


def test_a_dead_server_still_looks_ready(chapter: Executed) -> None:
    assert chapter.text("m8-run") == "ready: True\nNoAnswerError\n"


def test_a_synchronous_call_in_a_callback_deadlocks_and_await_does_not(chapter: Executed) -> None:
    printed = chapter.text("m4-run")
    assert in_order(
        printed, "no answer from report", "<report.py: running>", "asking for the position", "directly: x"
    )
    assert "got it" not in printed
    fixed = chapter.text("m4-fix-run")
    assert in_order(fixed, "nobody offers where_am_i", "success=True, message='I am at x")


def test_walking_takes_more_power_than_standing(chapter: Executed) -> None:
    watts = [float(number) for number in re.findall(r"(\d+) W", chapter.text("battery-power"))]
    assert watts[1] > 1.5 * watts[0] > 30


def test_nan_compares_false_with_everything(chapter: Executed) -> None:
    assert re.findall(r"True|False", chapter.text("nan")) == ["False", "False", "False", "True"]


def test_the_hurried_battery_misleads_in_both_directions(chapter: Executed) -> None:
    printed = chapter.text("battery-break-run")
    assert in_order(printed, "True 0.0 -> walk home", "a full battery:", "-> go on", "15.0 -> go on")


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("response.success = False", "return response inside the `if`"),
        ("return None", "end each path of the callback with `return response`"),
        ("return response", "an empty message"),
        ("response.success = True\nreturn response", "success=True without one message on odom"),
        ("response.succes = False\nreturn response", "AttributeError"),
    ],
)
def test_the_gap_of_a_server_without_odom_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("where_am_i_fixed.py", lines)
