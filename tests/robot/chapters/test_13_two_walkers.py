"""The cells of chapter 13 show what its text says; without the optional G1 only its gap is tried."""

from __future__ import annotations

import re

from execution import Executed, in_order, number, numbers, words_of
from gap_trials import GapTrials, Trial

CHAPTER = "13_two_walkers"
ROBOTS = ("humanoid", "g1")


def line_of(robot: str, printed: str) -> str:
    """The line that begins with the robot's name."""
    found = re.search(rf"^{robot}: (.*)", printed, re.MULTILINE)
    assert found, printed
    return found[1]


def test_each_robot_walks_at_its_own_limit_when_more_is_asked_for(chapter: Executed) -> None:
    printed = chapter.text("goal-plot")
    humanoid, g1 = (number("# m/s", line_of(robot, printed)) for robot in ROBOTS)
    assert 0.36 < humanoid < 0.43 < g1 < 0.49
    assert in_order(chapter.html("goal-plot"), "humanoid: y, m", "g1: y, m")


def test_the_same_server_reaches_the_same_goal_with_both_robots(chapter: Executed) -> None:
    for robot in ROBOTS:
        assert line_of(robot, chapter.text("goal-run")).startswith("SUCCEEDED")
    assert in_order(words_of(chapter.html("goal-run")), "humanoid: SUCCEEDED", "g1: SUCCEEDED")


def test_a_cancelled_goal_ends_later_with_the_robot_that_stands_later(chapter: Executed) -> None:
    waits = [numbers(r"([\d.]+) s", line_of(robot, chapter.text("cancel-run"))) for robot in ROBOTS]
    assert [len(each) for each in waits] == [3, 3]
    assert max(waits[0]) < max(waits[1])
    assert in_order(words_of(chapter.html("cancel-run")), "humanoid: CANCELED", "g1: CANCELED")


def test_a_push_moves_the_arrival_aside_unless_the_server_measures_that_too(chapter: Executed) -> None:
    pushed, steered = (chapter.text(cell) for cell in ("push-run", "steer-push"))
    assert abs(number("# m to the left", line_of("g1", pushed))) > 0.2
    for robot in ROBOTS:
        assert line_of(robot, pushed).startswith("SUCCEEDED")
        assert line_of(robot, steered).startswith("SUCCEEDED")
        assert abs(number("# m along", line_of(robot, steered))) < 0.12
        assert abs(number("# m to the left", line_of(robot, steered))) < 0.12


def test_the_gap_says_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)
