"""Judges where the cup and the hand are in the end."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.walking.reports import require_error_code

from .endings import require_robot_upright, require_succeeded
from .truth import (
    LIFTED,
    as_tuple,
    carried,
    cup_at,
    grip_at,
    grips,
    place_of,
    reports,
    taken_from,
)

PLACED = 0.03  # m
HEIGHT = 0.02  # m above or below
UPRIGHT = 0.98
AT_REST = 0.03  # m/s
LEFT_ALONE = 0.03  # m
WITHDRAWN = 0.08  # m from the pads' middle to the cup's, or to where it was
OPENED = 0.065  # m; the cup has 6 cm
LOOSE = 0.3  # N
SAMPLES = 2  # of the simulator's 50 a second that are no accident


def require_placed(goal: Goal) -> None:
    """Require that the goal SUCCEEDED with the cup upright and at rest at its place, and the hand off it."""
    result = require_succeeded(goal)
    require_standing(
        goal, place_of(goal), result.t, "place_pose", lesson=_advice_on_the_place(goal, result.t)
    )
    require_put_down(goal)
    require_robot_upright(goal.run, goal.accepted_at, result.t)


def _advice_on_the_place(goal: Goal, t: float) -> str:
    """Say why the cup is elsewhere, by how it came there."""
    if math.dist(cup_at(goal.run, t).position, taken_from(goal)) < LEFT_ALONE:
        return "The cup is where it was: succeed only when objects/cup/pose says that it has arrived."
    if not carried(goal, t):
        return "The cup was never off the table: it was pushed there, or only reported."
    if math.dist(grip_at(goal.run, t).hand, cup_at(goal.run, t).position) < WITHDRAWN:
        return "The hand still holds it: open it, wait until it is open, withdraw it, then succeed."
    return (
        "The cup does not hang in the middle of the hand: before you lower it, measure where it is (objects/cup/pose) "
        "and where the hand is (r_hand/pose), and move the hand by what is missing."
    )


def require_standing(goal: Goal, place: Sequence[float], since: float, name: str, lesson: str) -> None:
    """Require that the cup stands at a place from `since` (s) to the end, upright and at rest, with no hand on it."""
    run = goal.run
    cups = reports(run, ev.ObjectTruth, since, run.end)
    off, worst = max(
        ((math.dist(cup.position[:2], place[:2]), cup) for cup in cups), key=lambda pair: pair[0]
    )
    expect(
        off <= PLACED,
        expected=f"the cup within {PLACED:.2f} m of {name} (x {place[0]:.2f}, y {place[1]:.2f} m) at the end",
        observed=f"{off:.2f} m away in the simulator (x {worst.position[0]:.2f}, y {worst.position[1]:.2f} m)",
        help=lesson,
        at=worst.t,
    )
    tilted = min(cups, key=lambda cup: cup.up)
    expect(
        tilted.up >= UPRIGHT and all(abs(cup.position[2] - place[2]) <= HEIGHT for cup in cups),
        expected="the cup upright on the table",
        observed=f"it lies, or is {tilted.position[2] - place[2]:+.2f} m too high or too low",
        help="Lower it until it touches the table, wait, and only then open the hand.",
        at=tilted.t,
    )
    fastest = max(cups, key=lambda cup: cup.speed)
    expect(
        fastest.speed <= AT_REST,
        expected="the cup at rest when the goal ended",
        observed=f"it moves at {fastest.speed:.2f} m/s",
        help="Open the hand, withdraw it, wait until objects/cup/pose changes no more, then make the terminal call.",
        at=fastest.t,
    )
    require_withdrawn(goal, since, place)


def require_put_down(goal: Goal) -> None:
    """Require that the cup was never let go in the air."""
    loose = [grip for grip in carried(goal, goal.run.end) if grip.force < LOOSE]
    expect(
        len(loose) < SAMPLES,
        expected="the cup put down, not dropped",
        observed="nothing held it while it was in the air",
        help="Lower it until objects/cup/pose says that it stands, and only then open the hand.",
        at=loose[0].t if loose else None,
    )


def require_withdrawn(goal: Goal, since: float, place: Sequence[float], *, opened: float = 0.0) -> None:
    """Require that the hand was off the cup and its place from `since` (s) to the end, and open by `opened` (m)."""
    for grip in grips(goal.run, since, goal.run.end):
        near = min(grip.distance, math.dist(grip.hand, place))
        expect(
            near >= WITHDRAWN and grip.opening >= opened,
            expected=f"the hand {'open and ' if opened else ''}withdrawn when the goal ended",
            observed=f"it is {grip.opening:.3f} m open, {near:.2f} m from where the cup is or was",
            help="Publish 0.09 on r_gripper/command, wait until the hand is open, move it back by 0.10 m, and only "
            "then make the terminal call.",
            at=grip.t,
        )


def require_filled_result(goal: Goal) -> None:
    """Require that the result tells where the cup is, and the largest force."""
    result = require_succeeded(goal)
    require_error_code(goal, "NONE", because="the cup is at its place")
    goal.expect(
        "error_msg", "", because="nothing went wrong", help="Fill error_msg only when the goal is aborted."
    )
    said = result.result.final_object_pose
    place = cup_at(goal.run, result.t).position
    off = math.dist(as_tuple(said.pose.position), place)
    expect(
        said.header.frame_id == "odom" and off <= LIFTED,
        expected=f"final_object_pose in frame odom near x {place[0]:.2f}, y {place[1]:.2f}, z {place[2]:.2f} m",
        observed=f"frame {said.header.frame_id!r}, {off:.2f} m from there",
        help="Copy the last message of objects/cup/pose, header and pose, before the terminal call.",
        at=result.t,
    )
    strongest = max(grip.force for grip in grips(goal.run, goal.accepted_at, result.t))
    lifted = max((grip.force for grip in carried(goal, result.t)), default=0.0)
    claimed = result.result.max_grasp_force
    expect(
        0.8 * lifted <= claimed <= strongest + 1.0 and claimed > 0.0,
        expected=f"max_grasp_force about {strongest:.1f} N, the largest that r_gripper/wrench measured",
        observed=f"{claimed:.1f} N",
        help="Keep the largest force.y of r_gripper/wrench since the goal began, not the one that was asked for.",
        at=result.t,
    )
