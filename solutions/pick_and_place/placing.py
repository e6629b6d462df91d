"""Where the cup and the hand are in the end."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring import SUCCEEDED, Failure, Goal, ev, expect, fall_after
from autograder.authoring.walking.life import ended_at, phase
from autograder.authoring.walking.reports import require_error_code

from .endings import require_succeeded
from .life import commanded, ends_by_itself, is_for_the_cup, is_possible, robbed_at, watched_until
from .truth import LIFTED, as_tuple, carried, cup_at, grip_at, grips, place_of, reports, taken_from

GOAL_TIMEOUT, TIMEOUT_SLACK = 60.0, 1.0  # s
PLACED = 0.03  # m
HEIGHT = 0.02  # m above or below
UPRIGHT = 0.98
AT_REST = 0.03  # m/s
LEFT_ALONE = 0.03  # m
WITHDRAWN = 0.08  # m from the pads' middle to the cup's, or to where it was
OPENED = 0.065  # m; the cup has 6 cm
LOOSE = 0.3  # N
SAMPLES = 2  # of the simulator's 50 a second that are no accident


def places(goal: Goal) -> str | None:
    """It SUCCEEDS, and the cup then stands within 0.03 m of place_pose, upright, at rest, with the hand off it."""
    if not ends_by_itself(goal) or not is_possible(goal):
        return None
    result = require_succeeded(goal)
    require_standing(goal, place_of(goal), "place_pose")
    took = result.t - goal.accepted_at
    expect(
        took <= GOAL_TIMEOUT + TIMEOUT_SLACK,
        expected=f"a goal of at most {GOAL_TIMEOUT:.0f} s",
        observed=f"it took {took:.0f} s",
        help="Move the hand at 0.1 to 0.2 m/s, and wait for what is measured instead of a fixed time.",
        at=result.t,
    )
    return phase(goal)


def _advice_on_the_place(goal: Goal) -> str:
    """Say why the cup is elsewhere, by how it came there."""
    assert goal.result
    t = goal.result.t
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


def require_standing(goal: Goal, place: Sequence[float], name: str, help: str = "") -> None:
    """Require that the cup stands at a place (m) from the goal's end on, upright and at rest, with no hand on it.

    `help` is what to do if it is elsewhere, by default it follows from how it came there.
    """
    since = ended_at(goal)
    cups = reports(goal.run, ev.ObjectTruth, since, watched_until(goal))
    worst = max(cups, key=lambda cup: math.dist(cup.position[:2], place[:2]))
    off = math.dist(worst.position[:2], place[:2])
    if off > PLACED:
        raise Failure(
            expected=f"the cup within {PLACED:.2f} m of {name} (x {place[0]:.2f}, y {place[1]:.2f} m) at the end",
            observed=f"{off:.2f} m away in the simulator (x {worst.position[0]:.2f}, y {worst.position[1]:.2f} m)",
            help=help or _advice_on_the_place(goal),
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


def puts_down(goal: Goal) -> str | None:
    """The object is put down, not dropped, and the robot keeps its balance."""
    if not is_for_the_cup(goal) or robbed_at(goal) or commanded(goal, "push"):
        return None
    until = watched_until(goal)
    held = carried(goal, until)
    loose = [grip for grip in held if grip.force < LOOSE]
    expect(
        len(loose) < SAMPLES,
        expected="the cup put down, not dropped",
        observed="nothing held it while it was in the air",
        help="Lower it until objects/cup/pose says that it stands, and only then open the hand.",
        at=loose[0].t if loose else None,
    )
    fallen = fall_after(goal.run, goal.accepted_at, until)
    expect(
        fallen is None,
        expected="a robot that keeps its balance while it reaches",
        observed="it fell",
        help="Publish nothing on motor_power, and give the arm time: a long reach in a jerk topples the robot.",
        at=fallen.t if fallen else None,
    )
    return "lifted" if held else "left on the table"


def require_withdrawn(goal: Goal, since: float, place: Sequence[float], *, opened: float = 0.0) -> None:
    """Require that the hand was off the cup and its place from `since` (s) on, and open by `opened` (m)."""
    for grip in grips(goal.run, since, watched_until(goal)):
        near = min(grip.distance, math.dist(grip.hand, place))
        expect(
            near >= WITHDRAWN and grip.opening >= opened,
            expected=f"the hand {'open and ' if opened else ''}withdrawn when the goal ended",
            observed=f"it is {grip.opening:.3f} m open, {near:.2f} m from where the cup is or was",
            help="Publish 0.09 on r_gripper/command, wait until the hand is open, move it back by 0.10 m, and only "
            "then make the terminal call.",
            at=grip.t,
        )


def fills_the_result_in(goal: Goal) -> str | None:
    """The result tells where the cup is, and the largest force that was measured."""
    result = goal.result
    if result is None or result.status != SUCCEEDED:
        return None
    require_error_code(goal, "NONE", because="the cup is at its place")
    goal.expect(
        "error_msg", "", because="nothing went wrong", help="Fill error_msg only when the goal is aborted."
    )
    said = result.result.final_object_pose
    place = cup_at(goal.run, result.t).position
    claimed_place = as_tuple(said.pose.position)
    off = math.dist(claimed_place, place)
    expect(
        claimed_place != place_of(goal),
        expected="final_object_pose as it was measured",
        observed="the very place_pose of the goal, to the last digit",
        help="Copy the last message of objects/cup/pose, header and pose, before the terminal call.",
        at=result.t,
    )
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
    return phase(goal)
