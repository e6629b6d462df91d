"""Chapter 7 shows what it says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed("07_cancel_and_preempt")


def test_without_a_cancel_callback_the_cancel_is_refused(chapter: Executed) -> None:
    assert in_order(chapter.text("m1-run"), "cancel: not accepted, return_code 0", "end:    SUCCEEDED")
    assert in_order(chapter.html("m1-draw"), "cancel_goal", "cancel not accepted", "SUCCEEDED")


def test_an_action_is_three_services_and_two_topics(chapter: Executed) -> None:
    listed = re.findall(
        r"^(service|topic) +/robot/turn_to/_action/(\w+) ", chapter.text("endpoints"), re.MULTILINE
    )
    services = {"cancel_goal", "get_result", "send_goal"}
    assert {name for kind, name in listed if kind == "service"} == services
    assert {name for kind, name in listed if kind == "topic"} == {"feedback", "status"}


def test_on_one_thread_the_server_is_deaf_and_blind(chapter: Executed) -> None:
    printed = chapter.text("m2-run")
    assert in_order(printed, "not accepted, return_code 3", "ABORTED (error_code 3")
    turned = re.search(r"turned by (\d+)° instead of 40°", printed)
    assert turned
    assert int(turned[1]) > 60


def test_the_fixed_server_is_canceled_only_when_the_robot_stands(chapter: Executed) -> None:
    assert in_order(
        chapter.text("fix-run"), "cancel: accepted, return_code 0", "end:    CANCELED", "robot:  STANDING"
    )
    drawn = chapter.html("fix-draw")
    assert in_order(drawn, "cancel_goal", "cancel accepted", "robot: STANDING", "status: CANCELED")


def test_a_late_cancel_changes_nothing(chapter: Executed) -> None:
    assert in_order(chapter.text("late-run"), "not accepted, return_code 3", "status: CANCELED")


def test_ending_the_goal_in_the_cancel_callback_ends_the_node(chapter: Executed) -> None:
    printed = chapter.text("m12-run")
    assert in_order(
        printed, "never answered", "<eager_turn.py: ended with exit status 1>", "invalid transition"
    )
    assert "robot: STANDING" in chapter.text("m12-robot")


def test_a_result_after_the_terminal_call_is_lost(chapter: Executed) -> None:
    assert in_order(chapter.text("m13-run"), "status: SUCCEEDED", "frame of final_pose: ''", "total_steps: 0")


def test_two_goals_run_at_once_until_one_preempts_the_other(chapter: Executed) -> None:
    both = chapter.text("two-run")
    assert in_order(both, "left:  EXECUTING", "right: EXECUTING", "ends:   CANCELED CANCELED")
    assert in_order(
        chapter.text("preempt-run"), "left:  ABORTED (error_code 2", "right: SUCCEEDED (error_code 0"
    )
    assert "cancel_goal" not in chapter.html("preempt-draw")


def test_a_fall_aborts_with_its_own_code(chapter: Executed) -> None:
    assert "ABORTED (error_code 1, error_msg 'the robot fell'" in chapter.text("fall-run")
    assert "FALLEN" in chapter.html("fall-show")


def test_the_button_cancels(chapter: Executed) -> None:
    assert chapter.text("button-code") == "end: CANCELED | robot: STANDING\n"
