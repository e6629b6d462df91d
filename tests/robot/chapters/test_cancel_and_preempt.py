"""The cells of chapter 7 show what its text says."""

from __future__ import annotations

import re

import nbformat
from execution import CHAPTERS, Executed, in_order
from gap_trials import GapTrials, Trial

CHAPTER = "07_cancel_and_preempt"


def test_without_a_cancel_callback_the_cancel_is_refused(chapter: Executed) -> None:
    assert in_order(chapter.text("m1-run"), "cancel: not accepted, return_code 0", "end:    SUCCEEDED")
    assert in_order(chapter.html("m1-draw"), "cancel_goal", "cancel not accepted", "SUCCEEDED")


def test_an_action_is_three_services_and_two_topics(chapter: Executed) -> None:
    printed = chapter.text("endpoints")
    assert in_order(
        printed, "/robot/turn_to [humanoid_interfaces/action/WalkTo]", "Action servers: 1", "/robot/turner"
    )
    listed = re.findall(r"^/robot/turn_to/_action/(\w+) \[\w+/(\w+)/", printed, re.MULTILINE)
    services = {"cancel_goal", "get_result", "send_goal"}
    assert {name for name, kind in listed if kind in ("srv", "action")} >= services
    assert {name for name, _ in listed} == services | {"feedback", "status"}


def test_on_one_thread_the_server_receives_neither_cancel_nor_odom(chapter: Executed) -> None:
    printed = chapter.text("m2-run")
    assert in_order(printed, "not accepted, return_code 3", "ABORTED (error_code 3")
    turned = re.search(r"turned by (\d+)°; the goal was 40°", printed)
    assert turned
    assert int(turned[1]) > 60


def test_the_fixed_server_is_canceled_only_when_the_robot_stands(chapter: Executed) -> None:
    assert in_order(
        chapter.text("fix-run"), "cancel: accepted, return_code 0", "end:    CANCELED", "robot:  STANDING"
    )
    drawn = chapter.html("fix-draw")
    assert in_order(drawn, "cancel_goal", "cancel accepted", "robot: STANDING", "status: CANCELED")


def test_a_cancel_is_drawn_with_what_the_robot_did(chapter: Executed) -> None:
    drawn = chapter.html("fix-plot")
    assert "A cancel, and what the robot does" in drawn
    took = re.search(r"Coloured, from the request to CANCELED: ([\d.]+) s", drawn)
    assert took
    assert 0.0 < float(took[1]) < 5.0


def test_a_late_cancel_changes_nothing(chapter: Executed) -> None:
    assert in_order(chapter.text("late-run"), "not accepted, return_code 3", "status: CANCELED")


def test_ending_the_goal_in_the_cancel_callback_ends_the_node(chapter: Executed) -> None:
    printed = chapter.text("m12-run")
    assert in_order(
        printed,
        "cancel: no answer within three seconds",
        "<eager_turn.py: ended with exit status 1>",
        "invalid transition",
    )
    assert "robot: STANDING" in chapter.text("m12-robot")


def test_a_result_after_the_terminal_call_is_lost(chapter: Executed) -> None:
    printed = chapter.text("m13-run")
    assert re.search(
        r"^20°: SUCCEEDED, frame of final_pose: 'odom', total_steps: [1-9]", printed, re.MULTILINE
    )
    assert " 0°: SUCCEEDED, frame of final_pose: '', total_steps: 0" in printed
    assert "ZeroDivisionError" in printed
    assert "✓ careful_turn.py: 0° ended ABORTED" in chapter.text("m13-fix-file")


def test_two_goals_run_at_once_until_one_preempts_the_other(chapter: Executed) -> None:
    both = chapter.text("two-run")
    assert in_order(both, "left:  EXECUTING", "right: EXECUTING", "0.4", "ends:   CANCELED CANCELED")
    assert re.search(r"^cmd_vel:(?=.* 0\.4)(?=.* -0\.4)", both, re.MULTILINE)
    assert in_order(
        chapter.text("preempt-run"), "left:  ABORTED (error_code 2", "right: SUCCEEDED (error_code 0"
    )
    assert "cancel_goal" not in chapter.html("preempt-draw")


def test_a_fall_aborts_with_its_own_code(chapter: Executed) -> None:
    assert "ABORTED (error_code 1, error_msg 'the robot fell'" in chapter.text("fall-run")
    assert "FALLEN" in chapter.html("fall-show")


def test_the_button_cancels(chapter: Executed) -> None:
    assert chapter.text("button-code") == "end: CANCELED | robot: STANDING\n"


def test_a_goal_from_the_command_line_is_turned_to_and_one_request_cancels_every_goal(
    chapter: Executed,
) -> None:
    printed = chapter.text("cli")
    assert in_order(printed, "Goal accepted", "distance_remaining: .nan", "total_steps: ", "SUCCEEDED")
    assert re.search(r"steps_taken: [1-9]", printed)
    printed = chapter.text("cancel-all")
    assert in_order(printed, "return_code=0, goals_canceling=[action_msgs", "end: CANCELED | robot: STANDING")


def test_feedback_of_a_turn_is_filled_five_times_a_second(gaps: GapTrials) -> None:
    gaps.run("import lab, math, time\nfrom humanoid_interfaces.action import WalkTo\nlab.start_robot()")
    gaps.run(_cell("goal"))
    gaps.run("server = start('cancellable_turn.py')\ngoal = lab.send_goal('turn_to', WalkTo, turn_by(90))")
    printed = gaps.run(
        "outcome = goal.result(show_feedback=False)\n"
        "last = goal.feedback[-1]\n"
        "left = [each.estimated_time_remaining.sec for each in goal.feedback]\n"
        "print(last.steps_taken > 3, math.isnan(last.distance_remaining), left[0] > 2, left[-1], len(goal.feedback))"
    )
    steps, has_no_distance, begins, ends, count = printed.split()
    assert (steps, has_no_distance, begins, ends) == ("True", "True", "True", "0")
    assert 12 <= int(count) <= 35  # in 4 to 6 s


def test_a_goal_is_rejected_until_the_server_has_data(gaps: GapTrials) -> None:
    gaps.run(
        "lab.stop_nodes()\nwhere = turn_by(20)\nlab.stop_robot()\nserver = lab.run_node('cancellable_turn.py')"
    )
    assert gaps.run("print(lab.send_goal('turn_to', WalkTo, where).accepted)") == "False\n"
    assert gaps.run("print(server)") == "<cancellable_turn.py: running>\n"


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)


def _cell(cell_id: str) -> str:
    notebook = nbformat.read(CHAPTERS / f"{CHAPTER}.ipynb", as_version=4)
    return next(cell.source for cell in notebook.cells if cell.id == cell_id)
