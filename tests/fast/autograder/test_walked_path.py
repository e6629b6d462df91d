"""The path that a robot has walked, without the sway of its pelvis."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.robot_record import RobotRecord
from autograder.authoring.walking.path import length, length_walked, length_without_sway, walking_speed
from humanoid_interfaces.msg import RobotState
from records import robot

SWAY = 0.03  # m to each side
STRIDE = 0.98  # s, two steps


def walk(x: Callable[[float], float], duration: float) -> RobotRecord:
    """A robot at x(t) m on a straight line, swaying as it goes, at 50 Hz."""

    def at(t: float) -> ev.RobotTruth:
        sway = SWAY * math.sin(2 * math.pi * t / STRIDE)
        return robot(t, mode=RobotState.WALKING, x=x(t), y=sway, speed=0.3)

    return RobotRecord.from_events("walk", {}, [at(0.02 * k) for k in range(int(duration / 0.02) + 1)])


def test_sway_does_not_count_as_distance() -> None:
    run = walk(lambda t: 0.3 * t, 8.0)
    raw = length([(robot.x, robot.y) for robot in run.robot_between(1.0, 7.0)])
    assert raw > 1.06 * 1.8
    assert length_walked(run, 1.0, 7.0) == pytest.approx(1.8, rel=0.02)


def test_a_robot_that_sways_in_place_walks_no_distance() -> None:
    run = walk(lambda t: 0.0, 8.0)
    assert length_walked(run, 1.0, 7.0) < 0.05
    assert walking_speed(run, 4.0) < 0.02


def test_the_way_back_is_a_part_of_the_path() -> None:
    run = walk(lambda t: 0.3 * min(t, 8.0 - t), 8.0)
    # The mean cuts the point where it turns round, by half a stride's way.
    assert 1.8 - 0.3 * STRIDE / 2 - 0.05 < length_walked(run, 1.0, 7.0) < 1.8
    assert walking_speed(run, 2.0) == pytest.approx(0.3, abs=0.03)


def test_a_path_filtered_by_distance_contains_neither_sway_nor_the_last_corner() -> None:
    run = walk(lambda t: 0.3 * min(t, 8.0 - t), 8.0)
    assert length_without_sway(run, 1.0, 7.0, 0.2) == pytest.approx(1.8, abs=0.25)
    in_place = walk(lambda t: 0.0, 8.0)
    assert length_without_sway(in_place, 1.0, 7.0, 0.2) < 2 * SWAY
    assert length_without_sway(in_place, 1.001, 1.002, 0.2) == 0.0
