"""Scenarios and checks that the servers of walk_to share; the checks differ only in clauses, needs and lessons."""

from __future__ import annotations

import math
from functools import partial
from random import Random
from types import ModuleType
from typing import Any

from autograder.authoring import checks
from autograder.authoring.checks import RESTING, Check, Scenario
from autograder.authoring.obligation import check_of
from autograder.authoring.sequence import NOT_FINITE

in_order = partial(checks.in_order, robot=())  # with a robot that can walk

WRONG_POSES: list[list[Any]] = [
    ["ask", "wrong frame", "header.frame_id", "map"],
    ["ask", "NaN position", "pose.position.x", math.nan],
    ["ask", "NaN height", "pose.position.z", math.nan],
    ["ask", "NaN orientation", "pose.orientation.z", math.nan],
]
INTERRUPT = in_order(["interrupt"], robot=RESTING)
OTHER_NAMESPACE = in_order(["go", "walk", 0.3, 0.0, 0.0], ["arrive", "walk"], namespace="/lab_7/robot")


def impossible(random: Random, *more: tuple[str, Any]) -> list[list[Any]]:
    """Return steps that send goals in random order, each with one wrong field; `more` are further fields and values."""
    wrong: list[tuple[str, Any]] = [
        ("header.frame_id", random.choice(("base_link", "world", "odometry", "", "odom_combined"))),
        *((f"pose.position.{axis}", random.choice(NOT_FINITE)) for axis in "xyz"),
        *((f"pose.orientation.{axis}", random.choice(NOT_FINITE)) for axis in "xyzw"),
        *more,
    ]
    random.shuffle(wrong)
    return [["ask", f"impossible {number}", *each] for number, each in enumerate(wrong, start=1)]


def two_walks(first: float = 0.0, second: float = 0.0) -> Scenario:
    """Return the scenario of two walks with these limits (m/s).

    The second goal lies ahead of the robot, which has turned and taken steps before. The turn to it is so small that
    the speed can be measured. Its heading lies beyond pi, so its quaternion has a negative w.
    """
    walks = [["go", "walk", 0.55, 0.2, 2.8, first], ["go", "again", 0.15, 0.34, 3.3, second]]
    return in_order(*(step for go in walks for step in (go, ["arrive", go[1]], ["wait", 1.5])))


def rejections(model: ModuleType, *, on: Scenario, needs: Check, see: str) -> tuple[Check, Check]:
    """Return the checks rejects_a_wrong_frame and rejects_nan, of an exercise's model."""
    rejecting = partial(check_of, on=on, needs=needs, see=see)
    return (
        rejecting(model.rejects_frames, title="It rejects a pose in frame map"),
        rejecting(model.rejects_nan, title="It rejects a pose that holds NaN"),
    )


def reports(
    model: ModuleType, *, on: Scenario, under_way: Check, arrives: Check
) -> tuple[Check, Check, Check, Check]:
    """Return the checks fills_the_result, feedback_keeps_its_rate, feedback_is_true and feedback_ends_with_the_goal.

    `on` has two goals. The checks of feedback need `under_way`, the check of the result needs `arrives`.
    """
    of_both = partial(check_of, on=on)
    result = of_both(
        [model.accepts, model.reports_where_it_ended],
        title="Each result, also of a second goal, holds where the robot ended, the steps for this goal, and NONE",
        needs=arrives,
    )
    rate = of_both(model.feedback_at_5_hz, needs=under_way)
    truth = of_both(
        [model.feedback_is_true, model.estimates_the_time],
        title="Pose, distance and steps in the feedback are the robot's, and the time left is a plausible estimate",
        needs=rate,
    )
    end = of_both(model.feedback_ends_with_the_goal, needs=[arrives, rate])
    return result, rate, truth, end


def fall_is_reported(model: ModuleType, *, on: Scenario, needs: Check) -> Check:
    """Return the check aborts_when_the_robot_falls, of an exercise's model."""
    return check_of(
        [model.tells_a_fall, model.says_why_it_aborted],
        title="When the robot falls the goal is ABORTED with FELL, and says so",
        on=on,
        needs=needs,
    )
