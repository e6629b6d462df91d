"""The cells of chapter 8 show what its text says."""

from __future__ import annotations

import re

from execution import Executed, in_order, number, numbers, on_paper, words_of
from gap_trials import GapTrials, Trial

CHAPTER = "08_navigation"


def test_the_action_has_the_fields_of_nav2(chapter: Executed) -> None:
    printed = chapter.text("action")
    fields = "current_pose navigation_time estimated_time_remaining number_of_recoveries distance_remaining"
    assert in_order(printed, *fields.split())


def test_three_loops_succeed_beside_the_goal(chapter: Executed) -> None:
    printed = chapter.text("loops-run")
    assert "end: SUCCEEDED" in printed
    assert number(r"stands (\d+) cm", printed) > 25
    assert in_order(printed, "phases:", "turning to the goal", "walking", "turning to the heading")


def test_a_robot_that_is_turned_off_its_way_gets_back_and_counts_it(chapter: Executed) -> None:
    printed = chapter.text("recovery-run")
    assert "end: SUCCEEDED" in printed
    assert number(r"recoveries: (\d+)", printed) >= 1
    assert number(r"stands (\d+) cm", printed) <= 60


def test_the_trip_is_filmed_from_above_with_its_phases_and_what_happened(chapter: Executed) -> None:
    html = chapter.html("recovery-plot")
    assert "data:image/webp" in html
    words = words_of(html)
    assert in_order(
        words,
        *("Phases:", "walking", "turning to the goal", "walking", "there"),
        *("push", "the joystick takes the robot", "it lets go", "In the end SUCCEEDED"),
    )
    assert number(r"SUCCEEDED, ([\d.]+) m from the goal", words) <= 0.65


def test_the_trip_is_filmed(chapter: Executed) -> None:
    assert "The robot for" in chapter.html("film")


def test_a_naive_sum_of_odom_overcounts_and_the_filtered_one_does_not(chapter: Executed) -> None:
    printed = chapter.text("sway-run")
    straight = number(r"start to end: ([\d.]+) m", printed)
    assert 1.3 < straight < 1.8  # a busy notebook stops the walk too late
    assert number(r"pieces of odom:  ([\d.]+) m", printed) > max(1.7, 1.15 * straight)
    drawn = on_paper(chapter, "odometer-plot")
    assert "shortest, m: 0.2. In the lab, a slider goes up to 1." in drawn
    words = words_of(drawn)
    assert abs(number(r"([\d.]+) m in pieces of at least 0\.2 m", words) - straight) < 0.15 * straight
    assert number(r"all pieces: .*? to ([\d.]+) at", words) == number(r"pieces of odom:  ([\d.]+) m", printed)


def test_the_measured_speed_is_right_on_the_way_and_wrong_in_the_turn(chapter: Executed) -> None:
    words = words_of(chapter.html("eta-run"))
    start = r": time left, s from (-?[\d.]+) at"
    truth = number(f"truth{start}", words)
    assert number(f"measured speed{start}", words) > 1.5 * truth
    assert number(f"top speed{start}", words) < truth / 2
    stay = re.search(r"measured speed: inside the band from ([\d.]+) to (\d+\.\d+)", words)
    assert stay
    assert float(stay[1]) > truth / 2  # after the turn
    assert float(stay[2]) - float(stay[1]) > 1.5


def test_progress_by_distance_is_nonsense_where_nothing_is_to_be_walked(chapter: Executed) -> None:
    printed = chapter.text("zero-run")
    assert "end: SUCCEEDED" in printed
    assert max(abs(each) for each in numbers(r"(-?\d+) %", printed)) > 1000


def test_progress_that_knows_what_nothing_is_stays_at_100(chapter: Executed) -> None:
    assert set(numbers(r"(-?\d+) %", chapter.text("zero-fix-run"))) == {100.0}


def test_a_trip_that_takes_too_long_is_aborted_with_timeout(chapter: Executed) -> None:
    assert "ABORTED (error_code 3, error_msg 'not there after 20 s'" in chapter.text("late-run")


def test_the_numbers_of_the_text_are_impossible_and_those_of_the_run_are_not(chapter: Executed) -> None:
    printed = chapter.text("book-check")
    assert in_order(printed, "1.15 m/s", "1.45 m/s", "12 %", "after 2 s")
    assert in_order(chapter.text("book-run"), "end: SUCCEEDED", "turning to the goal", "walking", "m left")
    checked = chapter.text("book-run-check")
    speeds = numbers(r"s: (-?[\d.]+) m/s", checked)
    assert len(speeds) >= 3
    assert all(0.1 < speed < 0.5 for speed in speeds)
    assert number(r"stands (\d+) cm", checked) <= 60


def test_a_key_the_command_line_and_a_button_cancel(chapter: Executed) -> None:
    assert in_order(chapter.text("stop-q"), "q: 1 goal to be canceled", "end: CANCELED")
    assert in_order(chapter.text("stop-ctrl-c"), "Canceling goal", "Goal canceled", "robot: STANDING")
    printed = chapter.text("stop-both")
    assert in_order(printed, "button: return_code 0, 1 goal", "end: CANCELED", "goals_canceling=[]")


def test_a_second_cancel_of_the_same_goal_is_answered_with_3(chapter: Executed) -> None:
    first, second, end = chapter.text("twice-run").splitlines()
    assert "accepted, return_code 0" in first
    assert "not accepted" not in first
    assert in_order(second, "not accepted, return_code 3", "CANCELING")
    assert end == "end:    CANCELED"


def test_a_cancel_before_the_acceptance_finds_no_goal(chapter: Executed) -> None:
    early, then, robot, again = chapter.text("early-run").splitlines()
    assert early == "early: return_code 0, 0 goals to be canceled"
    assert then == "then:  accepted"
    assert robot == "robot: WALKING"
    assert again == "again: accepted, return_code 0 | end: CANCELED"


def test_canceled_is_not_standing(chapter: Executed) -> None:
    first, second = chapter.text("standing-run").splitlines()
    assert first == "status: CANCELED | robot: WALKING"
    assert second == "status: CANCELED | robot: STANDING"
    words = words_of(chapter.html("standing-run"))
    assert in_order(words, "Coloured, keep away:", "result: CANCELED", "WALKING → STANDING")
    assert number(r"keep away: ([\d.]+) s", words) > 0.2


def test_every_comparison_with_nan_is_false_and_float32_is_not_the_number(chapter: Executed) -> None:
    assert re.findall(r"True|False", chapter.text("guard-traps")) == ["False", "True", "False", "False"]
    assert in_order(
        chapter.text("float-run"),
        "received 0.20000000298023224, below: False",
        "received 0.69",
        "below: True",
    )


def test_the_guard_cancels_once_and_waits_for_both(chapter: Executed) -> None:
    printed = chapter.text("watch-run")
    assert in_order(printed, "0.30: go on", "0.22: go on", "0.19: cancel", "cancel: accepted")
    assert in_order(printed, "status: CANCELED", "robot:  STANDING")


def test_there_is_no_map(chapter: Executed) -> None:
    assert in_order(chapter.text("map"), "no tf, no map", "frame_id: odom", "child_frame_id: base_link")


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)
