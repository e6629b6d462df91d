"""The cells of chapter 6 show what its text says."""

from __future__ import annotations

import re

import pytest
from execution import Executed, in_order, words_of
from gap_trials import GapTrials, Trial

CHAPTER = "06_walk_to_a_pose"


def test_the_type_has_goal_result_and_feedback(chapter: Executed) -> None:
    assert in_order(
        chapter.text("show"), "PoseStamped target_pose", "---", "error_code", "---", "distance_remaining"
    )


def test_a_rejection_carries_no_reason(chapter: Executed) -> None:
    assert chapter.text("reject-fields") == "{'accepted': 'boolean', 'stamp': 'builtin_interfaces/Time'}\n"
    printed = chapter.text("reject-run")
    assert printed.count("accepted False") == 3
    assert "1.0 m in base_link: ABORTED (error_code 0, error_msg 'this server cannot walk yet'" in printed
    assert in_order(
        chapter.text("reject-cli"),
        "/robot/go_ahead [humanoid_interfaces/action/WalkTo]",
        "Action servers: 1",
        "/robot/walker",
        "Goal was rejected.",
    )


def test_a_goal_without_a_terminal_call_is_aborted(chapter: Executed) -> None:
    printed = chapter.text("move-run")
    steps = re.search(r"ABORTED \(error_code 0, error_msg '', .*total_steps (\d+)\)", printed)
    assert steps
    assert int(steps[1]) > 2
    assert "Goal state not set, assuming aborted" in printed


def claimed_and_stands(printed: str) -> tuple[float, float]:
    """What a walk's result says and where the robot stands, m ahead."""
    found = re.search(r"the result says ([\d.]+) m\nthe robot stands at ([\d.]+) m: STANDING", printed)
    assert found
    return float(found[1]), float(found[2])


def test_a_success_in_mid_step_is_false_and_one_after_settling_is_true(chapter: Executed) -> None:
    touched = chapter.text("touch-run")
    assert "SUCCEEDED, and the robot is WALKING" in touched
    claimed, stands = claimed_and_stands(touched)
    assert 0.95 < claimed < 1.25  # a delayed loop detects the goal late
    assert stands - claimed > 0.04
    settled = chapter.text("settle-run")
    assert "SUCCEEDED, and the robot is STANDING" in settled
    claimed, stands = claimed_and_stands(settled)
    assert stands == pytest.approx(claimed, abs=0.025)
    assert stands == pytest.approx(1.0, abs=0.13)


def test_the_sway_is_plotted_with_the_end_of_the_goal(chapter: Executed) -> None:
    words = words_of(chapter.html("touch-plot"))
    assert in_order(words, "x in m:", "y in m:", "speed in m/s:", "Dashed beside x: the goal.")
    assert in_order(words, "result: SUCCEEDED", "WALKING → STANDING")
    sway = re.search(r"y in m: .*?lowest ([-\d.]+) at [\d.]+ s, highest ([-\d.]+) at", words)
    assert sway
    assert float(sway[2]) - float(sway[1]) > 0.03


def test_two_films_show_where_the_robot_is_when_the_status_comes_and_where_it_stands(
    chapter: Executed,
) -> None:
    html = chapter.html("settle-plot")
    assert "data:image/webp" in html
    assert in_order(words_of(html), "succeed at the goal: SUCCEEDED", "settle, then succeed: SUCCEEDED")
    at_once, settled = re.findall(
        r"SUCCEEDED after ([\d.]+) s, ([\d.]+) m (past|before) the goal, (\w+); "
        r"in the end ([\d.]+) m (past|before) the goal, (\w+)\.",
        words_of(html),
    )
    assert (at_once[3], settled[3]) == ("WALKING", "STANDING")
    assert (at_once[6], settled[6]) == ("STANDING", "STANDING")
    assert _past(*at_once[4:6]) - _past(*at_once[1:3]) > 0.04
    assert abs(_past(*settled[4:6]) - _past(*settled[1:3])) < 0.025


def _past(metres: str, side: str) -> float:
    return float(metres) if side == "past" else -float(metres)


def test_the_button_walks_and_the_last_feedback_comes_from_where_the_robot_stands(chapter: Executed) -> None:
    printed = chapter.text("feedback-code")
    found = re.search(r"SUCCEEDED after (\d+) feedback messages; the last said ([\d.]+) m", printed)
    assert found
    assert 15 <= int(found[1]) <= 60
    assert float(found[2]) <= 0.1
    assert in_order(
        chapter.text("feedback-cli"), "Goal accepted", "distance_remaining: 0.", "total_steps", "SUCCEEDED"
    )


def test_a_fall_is_seen_by_nobody_until_the_loop_looks(chapter: Executed) -> None:
    printed = re.match(
        r"FALLEN \| EXECUTING \| ([\d.]+) m ([\d.]+) m ([\d.]+) m\n", chapter.text("fall-break")
    )
    assert printed, chapter.text("fall-break")
    left = [float(distance) for distance in printed.groups()]
    assert max(left) - min(left) < 0.05  # the body may still be moving
    assert "ABORTED (error_code 1, error_msg 'the robot fell on the way'" in chapter.text("whole-run")
    assert in_order(chapter.html("whole-draw"), "SENT at", "ACCEPTED at", "EXECUTING at", "ABORTED at")


def test_the_client_without_a_status_takes_a_fall_for_an_arrival(chapter: Executed) -> None:
    assert in_order(
        chapter.text("hopeful-well"),
        "<hopeful.py: exit status 0",
        "m left",
        "arrived, with",
        "<hopeful.py: exit status 2",
        "go_ahead rejects the goal",
    )
    printed = chapter.text("hopeful-run")
    assert in_order(printed, "<hopeful.py: exit status 0", "arrived, with", "robot: FALLEN")
    assert in_order(
        chapter.text("follow-run"), "<follow.py: exit status 3", "status 6: the robot fell on the way"
    )


def test_each_line_of_the_client_stands_beside_its_arrow(chapter: Executed) -> None:
    program = next(cell.source for cell in chapter.notebook.cells if cell.id == "hopeful-file")
    assert in_order(
        program,
        *("def on_feedback(message):  # arrow 4", "feedback_callback=on_feedback)  # arrow 1"),
        *(
            "spin_until_future_complete(node, answer, timeout_sec=5.0)  # arrow 2",
            "accepted:  # what arrow 2",
        ),
        *(
            "get_result_async()  # arrow 3",
            "(node, end, timeout_sec=60.0)  # arrows 4 and 6",
            "what arrow 6 says",
        ),
    )


def test_one_level_too_few_ends_the_client_and_not_the_walk(chapter: Executed) -> None:
    printed = chapter.text("field-run")
    assert in_order(
        printed,
        "<one_level.py: exit status 1",
        "AttributeError: 'WalkTo_FeedbackMessage' object has no attribute 'distance_remaining'",
        "robot: WALKING",
        "robot: STANDING after",
    )


def seen(printed: str) -> list[int]:
    """The numbers of the feedback messages that the slow client saw."""
    found = re.search(r"\d+ seen:([\d ]*)", printed)
    assert found
    return [int(number) for number in found[1].split()]


def test_a_slow_client_sees_the_newest_feedback_and_none_after_the_result(chapter: Executed) -> None:
    while_it_works, after_the_result = seen(chapter.text("slow-run")), seen(chapter.text("slow-end"))
    assert 10 <= len(while_it_works) <= 20
    assert while_it_works[-10:] == list(range(41, 51))
    assert len(after_the_result) < 10


def test_a_result_expires(chapter: Executed) -> None:
    printed = chapter.text("late-run")
    assert re.search(
        r"after 0\.5 s: .*\n    status topic: 4\n    result: status 4, [1-9]\d* steps\n", printed
    )
    assert re.search(r"after 4\.0 s: .*\n    status topic: 4\n    result: status 0, 0 steps\n", printed)


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)


def test_the_goal_callback_may_be_a_coroutine(gaps: GapTrials) -> None:
    program = gaps.solved["rejecting_walk.py"].replace("def on_goal", "async def on_goal")
    assert "✓" in gaps.run("%%gap rejecting_walk.py\n" + program)
