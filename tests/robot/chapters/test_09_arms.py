"""The cells of chapter 9 show what its text says."""

from __future__ import annotations

import re

from execution import Executed, in_order, number, numbers
from gap_trials import GapTrials, Trial

CHAPTER = "09_arms"


def test_the_message_and_the_limits_are_shown(chapter: Executed) -> None:
    assert in_order(chapter.text("message"), "joint_names", "points", "positions", "time_from_start", "3.0")


def test_velocities_of_0_are_a_stop_and_no_velocities_are_none(chapter: Executed) -> None:
    printed = chapter.text("velocities-run")
    stop, through, straight = (
        number(rf"{name} +(-[\d.]+) rad/s", printed)
        for name in ("velocities 0", "-0.5, then 0", "no velocities")
    )
    assert stop > -0.2
    assert -0.43 < straight < -0.24
    assert -0.65 < through < straight - 0.05
    assert in_order(chapter.html("velocities-plot"), "velocities 0:", "no velocities:")


def test_a_trajectory_for_the_other_arm_stops_this_one(chapter: Executed) -> None:
    assert -1.4 < number(r"left elbow: (-[\d.]+) rad", chapter.text("replace-run")) < -1.1
    assert in_order(chapter.html("replace-run"), "l_elbow in rad", "r_elbow in rad", "the right elbow")


def test_one_trajectory_for_both_arms_lets_both_go_on(chapter: Executed) -> None:
    words = chapter.html("merge-run")
    assert in_order(words, "l_elbow in rad", "r_elbow in rad", "both elbows")
    left, right = numbers(r"(-[\d.]+) at last", words)
    assert -2.05 < left < -1.95
    assert -0.55 < right < -0.45


def test_an_empty_trajectory_stops_the_motion(chapter: Executed) -> None:
    words = chapter.html("brake-run")
    assert "empty" in words
    assert -1.4 < number(r"(-[\d.]+) at last", words) < -1.1


def test_an_ignored_or_clamped_trajectory_is_not_reported(chapter: Executed) -> None:
    printed = chapter.text("silent-run")
    assert -0.05 < number(r"measured (-[\d.]+) rad", printed) < 0.0
    assert printed.count("robot.humanoid logs:") == 1
    assert in_order(printed, "robot.humanoid logs: joint_trajectory ignored", "l_elbo")


def test_the_action_has_the_codes(chapter: Executed) -> None:
    printed = chapter.text("move-arm")
    assert in_order(printed, "PATH_TOLERANCE_VIOLATED=2", "GOAL_TOLERANCE_VIOLATED=3", "float64 max_error")


def test_the_clock_succeeds_beside_the_goal(chapter: Executed) -> None:
    printed = chapter.text("clock-run")
    assert "end: SUCCEEDED" in printed
    assert number(r"elbow: (-[\d.]+) rad", printed) > -1.2


def test_two_tolerances_find_two_faults(chapter: Executed) -> None:
    free, early, late = re.findall(r"held at .*: .*", chapter.text("bend-run"))
    assert in_order(free, "held at None: SUCCEEDED", "error_code 0")
    assert in_order(early, "held at -0.9: ABORTED", "error_code 2", "l_elbow is 0.5", "off its trajectory")
    assert in_order(late, "held at -1.7: ABORTED", "error_code 3", "from its last point")
    assert 0.06 < number(r"l_elbow is ([\d.]+) rad", late) < 0.4
    for cell in ("bend-run", "bend-late-plot"):
        assert in_order(chapter.html(cell), "Dashed beside l_elbow: trajectory", "held", "result: ABORTED")


def test_an_aborted_arm_jumps_when_it_is_let_go_unless_it_was_told_to_hold(chapter: Executed) -> None:
    pattern = r"let go at (-[\d.]+) rad, it went to (-[\d.]+) rad"
    for cell, least, most in (("release-run", 0.8, 1.2), ("release-fix-run", 0.3, 0.65)):
        printed = chapter.text(cell)
        assert "end: ABORTED" in printed
        found = re.search(pattern, printed)
        assert found, printed
        assert least < float(found[1]) - float(found[2]) < most
        assert 39 < number(r"presses with ([\d.]+) N·m", printed) < 41
    assert chapter.html("release-films").count('alt="The robot for') == 2


def test_an_arm_that_is_told_to_stay_where_it_is_measured_hardly_presses_or_jumps(chapter: Executed) -> None:
    printed = chapter.text("release-yield-run")
    before, after = re.search(r"let go at (-[\d.]+) rad, it went to (-[\d.]+) rad", printed).groups()
    assert "end: ABORTED" in printed
    assert abs(float(before) - float(after)) < 0.1
    assert number(r"presses with ([\d.]+) N·m", printed) < 10


def test_the_cup_is_seen_and_what_is_too_far_is_refused(chapter: Executed) -> None:
    assert in_order(chapter.text("cup-look"), "x: 0.3", "error_code=-31", "too short")
    assert "around the cup: True" in chapter.text("reach")
    assert number(r"hand to cup: (\d+) mm", chapter.text("reach")) < 15


def test_the_force_is_what_the_opening_lacks(chapter: Executed) -> None:
    forces = dict(re.findall(r"asked for (\d) cm: +([\d.]+) N", chapter.text("force-run")))
    assert float(forces["7"]) == 0.0
    for opening in "543":
        expected = 400 * (0.06 - int(opening) / 100)
        assert abs(float(forces[opening]) - expected) < 0.25 * expected + 0.5, forces


def test_a_weak_grip_slips_and_a_firm_one_lifts(chapter: Executed) -> None:
    weak, firm = chapter.text("slip-run"), chapter.text("firm-run")
    assert number(r"pressed with ([\d.]+) N", weak) < 0.9
    assert number(r"the cup is (-?[\d.]+) cm", weak) < 1.0
    assert 5.5 < number(r"pressed with ([\d.]+) N", firm) < 8.5
    assert number(r"the cup is (-?[\d.]+) cm", firm) > 8.0
    assert chapter.html("grasp-films").count('alt="The robot and the cup for') == 2


def test_a_cancel_that_opens_the_hand_drops_the_cup(chapter: Executed) -> None:
    printed = chapter.text("lift-run")
    assert "end: CANCELED" in printed
    assert number(r"cup is ([\d.]+) cm below", printed) > 4.0
    assert number(r"went down by up to ([\d.]+) cm", printed) > 4.0
    assert in_order(
        chapter.html("lift-run"), "grip in N", "cup height in m", "cancel accepted", "result: CANCELED"
    )
    assert "The robot and the cup for" in chapter.html("lift-film")


def test_a_cancel_that_puts_the_cup_down_does_not(chapter: Executed) -> None:
    printed = chapter.text("careful-run")
    assert "end: CANCELED" in printed
    assert number(r"the cup is ([\d.]+) cm (?:above|below) its place", printed) < 0.5
    assert number(r"went down by up to ([\d.]+) cm", printed) < 2.5
    words = chapter.html("careful-run")
    took = number(r"([\d.]+) s: result: CANCELED", words) - number(r"([\d.]+) s: cancel requested", words)
    assert 1.0 < took < 3.5
    assert in_order(chapter.html("careful-draw"), "<title>A cancel while the hand holds a cup", "CANCELED")


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)


THERE = "if error <= GOAL_TOLERANCE:\n    return THERE\n"
