"""Where the cup and the hand are at the end of a goal."""

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
PLACE_TOLERANCE = 0.03  # m
HEIGHT_TOLERANCE = 0.02  # m
UPRIGHT = 0.98  # vertical component of the cup's axis, a unit vector
REST_SPEED = 0.03  # m/s
UNMOVED = 0.03  # m; a cup that is this near to where it was has not been moved
WITHDRAWN = 0.08  # m from the middle of the pads to the cup's centre, or to where it was
OPENED = 0.065  # m; the cup is 6 cm wide
LOOSE_FORCE = 0.3  # N; a hand that presses less does not hold the cup
MIN_LOOSE_SAMPLES = 2  # of the simulator's 50 a second; fewer may be noise


def places(goal: Goal) -> str | None:
    """The goal SUCCEEDS, with the cup upright and at rest within 0.03 m of place_pose, and the hand withdrawn."""
    if not ends_by_itself(goal) or not is_possible(goal):
        return None
    result = require_succeeded(goal)
    require_standing(goal, place_of(goal), "place_pose")
    took = result.t - goal.accepted_at
    expect(
        took <= GOAL_TIMEOUT + TIMEOUT_SLACK,
        expected=f"a result within {GOAL_TIMEOUT:.0f} s",
        observed=f"the goal took {took:.0f} s",
        help="Move the hand at 0.1 to 0.2 m/s, and wait for measurements (r_hand/pose, r_gripper/wrench) instead of "
        "fixed times.",
        at=result.t,
    )
    return phase(goal)


def _advice_on_the_place(goal: Goal) -> str:
    """Return advice on a cup that is not at place_pose."""
    assert goal.result
    t = goal.result.t
    if math.dist(cup_at(goal.run, t).position, taken_from(goal)) < UNMOVED:
        return "The cup is where it was: call succeed() only when objects/cup/pose is at place_pose."
    if not carried(goal, t):
        return "The cup was pushed along the table: grasp it, lift it, move it across, then lower it."
    if math.dist(grip_at(goal.run, t).hand, cup_at(goal.run, t).position) < WITHDRAWN:
        return "The hand still holds the cup: open the hand, wait until it is open, withdraw it, then call succeed()."
    return (
        "The cup is not exactly in the middle of the hand: before you lower it, compare objects/cup/pose with "
        "place_pose, and move the hand by the difference."
    )


def require_standing(goal: Goal, place: Sequence[float], name: str, help: str = "") -> None:
    """Require that from the goal's end on the cup stands at a place (m), upright, at rest, with the hand withdrawn.

    `help` is the advice for a cup that is elsewhere; by default it depends on how it got there.
    """
    since = ended_at(goal)
    cups = reports(goal.run, ev.ObjectTruth, since, watched_until(goal))
    worst = max(cups, key=lambda cup: math.dist(cup.position[:2], place[:2]))
    off = math.dist(worst.position[:2], place[:2])
    if off > PLACE_TOLERANCE:
        raise Failure(
            expected=f"the cup at the end within {PLACE_TOLERANCE:.2f} m of {name} "
            f"(x {place[0]:.2f}, y {place[1]:.2f} m)",
            observed=f"the cup {off:.2f} m away (x {worst.position[0]:.2f}, y {worst.position[1]:.2f} m)",
            help=help or _advice_on_the_place(goal),
            at=worst.t,
        )
    tilted = min(cups, key=lambda cup: cup.up)
    expect(
        tilted.up >= UPRIGHT and all(abs(cup.position[2] - place[2]) <= HEIGHT_TOLERANCE for cup in cups),
        expected="the cup upright on the table",
        observed=f"it leans by {math.degrees(math.acos(max(-1.0, min(1.0, tilted.up)))):.0f}°, with its centre "
        f"{tilted.position[2] - place[2]:+.2f} m from the right height",
        help="Lower the cup until it touches the table, wait, and only then open the hand.",
        at=tilted.t,
    )
    fastest = max(cups, key=lambda cup: cup.speed)
    expect(
        fastest.speed <= REST_SPEED,
        expected="the cup at rest when the goal ended",
        observed=f"it moved at {fastest.speed:.2f} m/s",
        help="Open the hand, withdraw it, and wait until objects/cup/pose no longer changes; then call succeed(), "
        "abort() or canceled().",
        at=fastest.t,
    )
    require_withdrawn(goal, since, place)


def puts_down(goal: Goal) -> str | None:
    """The cup is put down, not dropped, and the robot keeps its balance."""
    if not is_for_the_cup(goal) or robbed_at(goal) or commanded(goal, "push"):
        return None
    until = watched_until(goal)
    held = carried(goal, until)
    loose = [grip for grip in held if grip.force < LOOSE_FORCE]
    expect(
        len(loose) < MIN_LOOSE_SAMPLES,
        expected="the cup put down, not dropped",
        observed="the hand let go of it in the air",
        help="Lower the cup until objects/cup/pose shows that it stands on the table, and only then open the hand.",
        at=loose[0].t if loose else None,
    )
    fallen = fall_after(goal.run, goal.accepted_at, until)
    expect(
        fallen is None,
        expected="the robot to keep its balance while it moves the arm",
        observed="it fell",
        help="Do not publish on motor_power, and move the arm slowly: moving it far and fast topples the robot.",
        at=fallen.t if fallen else None,
    )
    return "lifted" if held else "left on the table"


def require_withdrawn(goal: Goal, since: float, place: Sequence[float], *, opened: float = 0.0) -> None:
    """Require that from `since` (s) on the hand was away from the cup and its place, and open by `opened` (m)."""
    for grip in grips(goal.run, since, watched_until(goal)):
        near = min(grip.distance, math.dist(grip.hand, place))
        expect(
            near >= WITHDRAWN and grip.opening >= opened,
            expected=f"the hand {'open and ' if opened else ''}withdrawn when the goal ended",
            observed=f"it was {grip.opening:.3f} m open, {near:.2f} m from where the cup is or was",
            help="Publish 0.09 on r_gripper/command, wait until the hand is open, and move it back by 0.10 m; only "
            "then call succeed(), abort() or canceled().",
            at=grip.t,
        )


def fills_the_result_in(goal: Goal) -> str | None:
    """The result has the cup's final pose and the largest force that was measured."""
    result = goal.result
    if result is None or result.status != SUCCEEDED:
        return None
    require_error_code(goal, "NONE", because="the goal SUCCEEDED")
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
        observed="exactly the place_pose of the goal",
        help="Copy header and pose of the last message on objects/cup/pose before succeed().",
        at=result.t,
    )
    expect(
        said.header.frame_id == "odom" and off <= LIFTED,
        expected=f"final_object_pose in frame odom near x {place[0]:.2f}, y {place[1]:.2f}, z {place[2]:.2f} m",
        observed=f"frame {said.header.frame_id!r}, {off:.2f} m from there",
        help="Copy header and pose of the last message on objects/cup/pose before succeed().",
        at=result.t,
    )
    strongest = max(grip.force for grip in grips(goal.run, goal.accepted_at, result.t))
    lifted = max((grip.force for grip in carried(goal, result.t)), default=0.0)
    claimed = result.result.max_grasp_force
    expect(
        0.8 * lifted <= claimed <= strongest + 1.0 and claimed > 0.0,
        expected=f"max_grasp_force about {strongest:.1f} N, the largest that r_gripper/wrench measured",
        observed=f"{claimed:.1f} N",
        help="Keep the largest force.y of r_gripper/wrench since the goal began; do not copy grasp_force.",
        at=result.t,
    )
    return phase(goal)
