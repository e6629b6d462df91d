"""What only the instructor's grading checks."""

from __future__ import annotations

import math

from autograder.authoring.checks import Scenario, check
from autograder.authoring.goal import SUCCEEDED
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.truth import require_arrival, require_stopped, require_walking

from .checks import (
    arrives,
    cancels_in_mid_stride,
    counts_no_detour_without_one,
    counts_the_recovery,
    measures_its_path,
    new_goal_preempts_the_old,
    tells_its_time,
)
from .odometer import require_measured_path
from .recoveries import require_detour_counted, require_no_detour
from .times import require_true_navigation_time


def _poses(random) -> dict:
    """Two poses a metre or so apart: one straight ahead with a small tolerance, then one behind it with a large one."""
    side = random.choice((-1, 1))
    x, y = random.uniform(0.6, 1.0), side * random.uniform(0.4, 0.8)
    first = (x, y, math.atan2(y, x))  # a turn at the end would bring a careless server nearer
    angle = random.uniform(-0.5, 0.5)
    second = (
        first[0] - 0.9 * math.cos(angle),
        first[1] - 0.9 * math.sin(angle),
        random.uniform(-math.pi, math.pi),
    )
    tolerances = (random.uniform(0.06, 0.08), random.uniform(0.15, 0.25))
    return {
        "poses": [
            [round(value, 3) for value in (*pose, tolerance)]
            for pose, tolerance in zip((first, second), tolerances, strict=True)
        ]
    }


RANDOM_POSES = Scenario("navigate_in_turn", _poses)
ANY_PHASE = Scenario(
    "cancel",
    lambda random: {
        "x": -1.5,
        "y": 0.5,
        "delays": [round(random.uniform(*span), 2) for span in ((0.3, 2.0), (2.5, 4.0))],
    },
)
TO_THE_OTHER_SIDE = Scenario(
    "lead_astray",
    lambda random: {
        "x": 1.8,
        "y": round(random.uniform(-0.2, 0.2), 2),
        "back": round(random.uniform(3.5, 4.5), 2),
        "turn": -1,
    },
)
OTHER_PREEMPT = Scenario(
    "preempt",
    lambda random: {
        "x": round(random.uniform(1.2, 1.5), 2),
        "y": round(random.uniform(-0.8, -0.4), 2),
        "yaw": round(random.uniform(-1.0, 0.0), 2),
        "after": round(random.uniform(2.5, 4.0), 2),
    },
)
OTHER_NAMESPACE = Scenario("navigate", {"x": 0.5, "y": 0.0, "yaw": 0.0}, namespace="/lab_7/robot")


@check(points=2, on=RANDOM_POSES, needs=arrives, see="06_walk_to_a_pose#settle-why", clauses=[2, 4])
def arrives_within_the_tolerance(run: Transcript) -> None:
    """It reaches poses with any heading, one after the other, each within its tolerance"""
    for number, (*_pose, tolerance) in enumerate(run.params["poses"], start=1):
        require_arrival(run.goal(f"leg {number}"), within=tolerance)


@check(
    points=1,
    on=RANDOM_POSES,
    needs=[arrives_within_the_tolerance, measures_its_path, counts_no_detour_without_one],
    see="08_navigation#odometer-why",
    clauses=[12, 15],
)
def tells_each_goal_its_own_story(run: Transcript) -> None:
    """Path and recoveries begin at 0 with each goal"""
    for number in range(1, len(run.params["poses"]) + 1):
        goal = run.goal(f"leg {number}")
        require_measured_path(
            goal,
            goal.require_result(SUCCEEDED),
            too_much="Begin the sum at 0 in every goal: keep it in execute, not in the node.",
        )
        require_no_detour(goal)


@check(
    points=1, on=ANY_PHASE, needs=cancels_in_mid_stride, see="07_cancel_and_preempt#fix-intro", clauses=[17]
)
def cancels_in_any_phase(run: Transcript) -> None:
    """Also while it turns a cancel ends CANCELED, with the robot still"""
    for delay in run.params["delays"]:
        request = run.goal(f"after {delay:g} s").require_canceled()
        require_walking(run, request.t)
        require_stopped(run, request.t)


@check(
    points=1, on=TO_THE_OTHER_SIDE, needs=counts_the_recovery, see="08_navigation#loops-why", clauses=[14, 15]
)
def gets_back_from_anywhere(run: Transcript) -> None:
    """Led astray to the other side, it counts that, too, and arrives"""
    require_detour_counted(run.goal("go"))
    require_arrival(run.goal("go"))


@check(
    points=1,
    on=OTHER_PREEMPT,
    needs=[new_goal_preempts_the_old, tells_its_time],
    see="08_navigation#conventions",
    clauses=[9],
)
def a_new_goal_has_a_time_of_its_own(run: Transcript) -> None:
    """navigation_time of a goal that preempts begins at its own acceptance"""
    require_arrival(run.goal("new"))
    require_true_navigation_time(run.goal("new"))


@check(points=1, on=OTHER_NAMESPACE, needs=arrives, see="01_robot_and_graph#names-why", clauses=[21])
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it walks the robot there"""
    require_arrival(run.goal("go"))
