"""Judges where the cup ended, how it was held, and how goals ended that could not be carried out."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure, expect
from autograder.authoring.falls import require_fell_told, require_knocked_over
from autograder.authoring.goal import ABORTED, SUCCEEDED, Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.missing import Missing
from autograder.authoring.robot_record import RobotRecord
from autograder.authoring.walking.reports import require_error_code
from humanoid_interfaces.action import PickAndPlace
from humanoid_interfaces.msg import RobotState

from .truth import (
    LIFTED,
    Grip,
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
FELL_OVER = 0.8
AT_REST = 0.03  # m/s
LEFT_ALONE = 0.03  # m
WITHDRAWN = 0.08  # m from the pads' middle to the cup's, or to where it was
OPENED = 0.065  # m; the cup has 6 cm
HIGH = 0.05  # m
BAND = 0.30  # of the force that was asked for
MOST_FORCE = 25.0  # N
HOLDING = 1.0  # N
LOOSE = 0.3  # N
SAMPLES = 2  # of the simulator's 50 a second that are no accident
GLITCHES = 0.02  # of the samples
MOVED = 0.05  # rad
OPENED_BY = 0.01  # m

_WHY_IT_GAVE_UP = {
    "UNKNOWN_OBJECT": "objects/cup/pose comes ten times a second. Is anything of your node served while execute "
    "waits? On one thread time.sleep keeps every message out: use MultiThreadedExecutor, or an async execute that "
    "awaits.",
    "UNREACHABLE": "Look at what you asked of compute_arm_ik: frame odom, the right arm, a hand that points ahead, a "
    "place above the table.",
    "GRASP_FAILED": "Was the open hand around the cup, 0.01 m above its centre, before it closed? And is the force "
    "that you compare force.y of r_gripper/wrench?",
    "DROPPED": "Let the fingers press with grasp_force before you lift. And when you put the cup down, the force may "
    "vanish: nothing is lost then.",
    "FELL": "Move the hand slowly, 0.2 m/s at most: a long reach in a jerk topples the robot.",
}
CODES = ("NONE", "UNKNOWN_OBJECT", "UNREACHABLE", "GRASP_FAILED", "DROPPED", "FELL", "PREEMPTED")
_FALLEN = RobotState.FALLEN


def require_succeeded(goal: Goal) -> ev.ResultReceived:
    """Require that a goal that can be carried out SUCCEEDED, and return its result."""
    goal.require_accepted()
    if goal.status == ABORTED and not why_rclpy_aborted(goal) and goal.result:
        said = goal.result.result
        raise Failure(
            expected="status SUCCEEDED",
            observed=f"status ABORTED, error_code {said.error_code} ({_code(goal)}): {said.error_msg[:200]!r}",
            help=_WHY_IT_GAVE_UP.get(
                _code(goal), "This goal can be carried out: find out why your server gave up."
            ),
            at=goal.result.t,
        )
    return goal.require_result(SUCCEEDED)


def _code(goal: Goal) -> str:
    """Return the name of the result's error_code."""
    assert goal.result
    code = goal.result.result.error_code
    return next((name for name in CODES if getattr(PickAndPlace.Result, name) == code), "no constant")


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


def require_lifted(goal: Goal) -> None:
    """Require that the cup was lifted on its way."""
    result = require_succeeded(goal)
    height = taken_from(goal)[2]
    top = (
        max(cup.position[2] for cup in reports(goal.run, ev.ObjectTruth, goal.accepted_at, result.t)) - height
    )
    expect(
        top >= HIGH,
        expected=f"the cup lifted by at least {HIGH:.2f} m on its way",
        observed=f"it was at most {top:.3f} m above where it stood",
        help="Close the hand, move it straight up by 0.12 m, then across, then down.",
        at=result.t,
    )


def require_force_kept(goal: Goal) -> None:
    """Require that the force was within 30 % of what was asked for while the cup was off the table."""
    result = require_succeeded(goal)
    wanted = goal.request.grasp_force
    low, high = wanted * (1 - BAND), min(MOST_FORCE, wanted * (1 + BAND))
    held = _require_carried(goal, result.t)
    outside = [grip for grip in held if not low <= grip.force <= high or grip.strongest > MOST_FORCE]
    worst = max(held, key=lambda grip: abs(grip.force - wanted))
    expect(
        len(outside) <= GLITCHES * len(held),
        expected=f"a grasp force from {low:.1f} to {high:.1f} N while the cup is in the air ({wanted:g} N asked for)",
        observed=f"{worst.force:.1f} N",
        help="A command is an opening, not a force. Each pad presses with 400 N for each metre by which the command is "
        "narrower than the object: measure on r_gripper/wrench, and change the opening by what is missing, before you "
        "lift.",
        at=worst.t,
    )


def _require_carried(goal: Goal, until: float) -> list[Grip]:
    """Return hand and cup while the cup was off the table, which it must have been."""
    held = carried(goal, until)
    expect(
        len(held) >= 5,
        expected="the cup off the table for a while",
        observed="it never was",
        help="Close the hand around the cup and lift it.",
        at=until,
    )
    return held


def require_robot_upright(run: RobotRecord, start: float, end: float) -> None:
    """Require that the robot kept its balance."""
    fallen = next((robot for robot in run.robot_between(start, end) if robot.mode == _FALLEN), None)
    expect(
        fallen is None,
        expected="a robot that keeps its balance while it reaches",
        observed="it fell",
        help="Publish nothing on motor_power, and give the arm time: a long reach in a jerk topples the robot.",
        at=fallen.t if fallen else None,
    )


def require_nothing_moved(goal: Goal, until: float) -> None:
    """Require that arm, waist, fingers and cup stayed where they were from the goal's arrival to `until` (s)."""
    run, start = goal.run, goal.sent.t
    joints = reports(run, ev.JointsTruth, start, until)
    for report in joints:
        joint, moved = max(
            ((name, abs(place - joints[0].positions[name])) for name, place in report.positions.items()),
            key=lambda pair: pair[1],
        )
        expect(
            moved <= MOVED,
            expected="an arm that stays where it is until the goal is known to be possible",
            observed=f"{joint} moved by {moved:.2f} rad",
            help="Ask compute_arm_ik for the grasp and for the place first; publish on joint_trajectory afterwards.",
            at=report.t,
        )
    seen = grips(run, start, until)
    moved = max(abs(grip.opening - seen[0].opening) for grip in seen)
    expect(
        moved <= OPENED_BY,
        expected="a hand that stays as it is until the goal is known to be possible",
        observed=f"it opened or closed by {moved:.3f} m",
        help="Open the hand after compute_arm_ik has found both places, not before.",
        at=until,
    )


def require_aborted(goal: Goal, code: str, *, because: str, help: str) -> ev.ResultReceived:
    """Require that a goal was ABORTED with an error_code and a reason, and return the result."""
    goal.require_accepted()
    result = goal.require_result(ABORTED, help=help)
    goal.expect(
        "error_code",
        getattr(PickAndPlace.Result, code),
        because=f"{because}: {code}",
        help=why_rclpy_aborted(goal) or f"It ended with {_code(goal)}. {help}",
    )
    expect(
        bool(result.result.error_msg.strip()),
        expected="error_msg with a reason for people",
        observed="an empty one",
        help="Fill result.error_msg before abort(): say what was tried, and what was seen instead.",
        at=result.t,
    )
    return result


def require_preempted_or_rejected(first: Goal, second: Goal) -> None:
    """Require that of two goals only one had the hand: the second was rejected, or took it after a safe end."""
    first.require_accepted()
    require_held_when(first, second.sent.t)
    if second.answer is not None and not second.answer.accepted:
        require_placed(first)
        return
    second.require_accepted()
    end = first.require_result(
        ABORTED,
        help="Two goals had one hand. Reject the second one in goal_callback, or end the first one with PREEMPTED.",
    )
    require_error_code(first, "PREEMPTED", because="a later goal has the hand")
    expect(
        end.t >= second.sent.t,
        expected="the first goal to go on until the second one comes",
        observed=f"it ended {second.sent.t - end.t:.1f} s before",
        help="Abort with PREEMPTED only when another goal has been accepted.",
        at=end.t,
    )
    require_placed(second)
    _require_never_fallen(second)


def _require_never_fallen(goal: Goal) -> None:
    tilted = min(reports(goal.run, ev.ObjectTruth, goal.sent.t, goal.run.end), key=lambda cup: cup.up)
    expect(
        tilted.up >= FELL_OVER,
        expected="a cup that stays upright while one goal gives way to another",
        observed="it fell over",
        help="Put down what is held, open, withdraw, and only then let the other goal begin.",
        at=tilted.t,
    )


def require_put_away(goal: Goal, place: Sequence[float], name: str) -> None:
    """Require that a goal, cancelled while the cup hung in the hand, ended CANCELED with the cup at a place."""
    request = goal.require_canceled()
    require_held_when(goal, request.t)
    assert goal.result
    require_standing(
        goal,
        place,
        goal.result.t,
        name,
        lesson="When the cancel comes, compare how far the cup is from where it stood and from place_pose, in x and y; "
        "carry it to the nearer one, put it down, open, withdraw, then call canceled().",
    )
    require_put_down(goal)
    require_robot_upright(goal.run, goal.accepted_at, goal.result.t)


def require_held_when(goal: Goal, t: float) -> None:
    """Require that the cup hung in the hand at a time (s); otherwise the scenario has not tested anything."""
    held = carried(goal, t)
    expect(
        bool(held) and held[-1].t >= t - 0.3 and held[-1].force >= HOLDING,
        expected="the cup off the table, in the hand, by then",
        observed="it is not",
        help=why_rclpy_aborted(goal) or "Grasp the cup and lift it before anything else is done with it.",
        at=t,
    )


def require_left_alone(goal: Goal) -> None:
    """Require that a goal cancelled before the grasp ended CANCELED, with the cup where it was and the hand off it."""
    request = goal.require_canceled()
    grip = grip_at(goal.run, request.t)
    expect(
        grip.distance <= 0.2,
        expected="the hand near the cup by then",
        observed=f"it is {grip.distance:.2f} m away",
        help="Bring the hand to the cup: approach it as soon as the goal executes.",
        at=request.t,
    )
    assert goal.result
    require_standing(
        goal,
        taken_from(goal),
        goal.result.t,
        "where it stood",
        lesson="Nothing is held yet: open the hand and draw it straight back, away from the cup, then call canceled().",
    )
    require_robot_upright(goal.run, goal.accepted_at, goal.result.t)


def require_grasp_failed(goal: Goal) -> ev.ResultReceived:
    """Require that a goal whose cup was taken away was ABORTED with GRASP_FAILED."""
    goal.require_accepted()
    taken = _taken(goal.run)
    result = require_aborted(
        goal,
        "GRASP_FAILED",
        because="nothing was between the fingers",
        help="The fingers closed on nothing, and the goal went on. After closing, r_gripper/wrench has to say at least "
        "1 N.",
    )
    expect(
        result.t >= taken,
        expected="the goal to go on until the hand has closed on nothing",
        observed=f"it ended {taken - result.t:.1f} s before the cup was taken away",
        help="Close the hand, wait, and look at the force then.",
        at=result.t,
    )
    return result


def require_dropped(goal: Goal) -> ev.ResultReceived:
    """Require that a goal whose cup was snatched out of the hand was ABORTED with DROPPED, soon."""
    goal.require_accepted()
    taken = _taken(goal.run)
    require_held_when(goal, taken)
    result = require_aborted(
        goal,
        "DROPPED",
        because="the force vanished on the way",
        help="The cup was gone and the goal went on. While you hold it, look at r_gripper/wrench in every round.",
    )
    expect(
        result.t >= taken,
        expected="the goal to go on while the cup hangs in the hand",
        observed=f"it ended {taken - result.t:.1f} s before the cup was lost",
        help="Compare the measured force with 1 N, not with grasp_force.",
        at=result.t,
    )
    return result


def _taken(run: RobotRecord) -> float:
    """Return when (s) the scenario took the cup away, for which hand and cup must have been as it waits for."""
    if run.one(ev.Mark, "name", "taken") is None:
        raise Missing(
            run, expected="a hand that gets as far as the cup", never="the cup was never taken away from it"
        )
    return run.told("move_object", name="cup").t


def require_aborted_by_a_fall(goal: Goal) -> None:
    """Require that a goal was ABORTED with FELL when the robot had been knocked over, and not before."""
    goal.require_accepted()
    require_fell_told(goal, require_knocked_over(goal.run))


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
