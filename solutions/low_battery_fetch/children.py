"""The goals that a fetch sent to the two actions it uses: which, where to, and what for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import expect_field, shown
from autograder.authoring.goal import Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.readiness import require_alive
from autograder.authoring.scripted_goal import ScriptedGoal
from autograder.authoring.standing import where_it_stood
from autograder.authoring.transcript import Transcript
from ros_runtime.message_constants import GoalStatus as StatusName
from ros_runtime.message_constants import name_of

NAVIGATE, PICK, BATTERY = "navigate_to_pose", "pick_and_place", "battery_state"
HOME = (0.0, 0.0)  # m in odom
ELSEWHERE = 0.3  # m from home
ASIDE = 0.1  # m between the tray and the place
STEPS = {
    1: "to the table (navigate_to_pose)",
    2: "takes the object (pick_and_place)",
    3: "home (navigate_to_pose)",
    4: "puts it down (pick_and_place)",
}
DEAD_END = (
    "Waiting for a child in a callback blocks the only thread, and its answer never gets in: await the future in an "
    "async execute callback, or use a MultiThreadedExecutor and callback groups that let the answers in."
)
LATCHED = "subscribe to it with QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL), which is reliable."


def children(goal: Goal) -> list[ScriptedGoal]:
    """Return the goals that the server sent for one goal of its own, in order of arrival."""
    run = run_of(goal)
    later = [event.t for event in run.all(ev.GoalSent) if event.t > goal.sent.t]
    until = later[0] if later else math.inf
    return [child for child in all_children(run) if goal.sent.t <= child.received.t < until]


def all_children(run: Transcript) -> list[ScriptedGoal]:
    """Return every goal that the server sent to either action, in order of arrival."""
    both = [*run.scripted_goals(NAVIGATE), *run.scripted_goals(PICK)]
    return sorted(both, key=lambda child: child.received.t)


def run_of(goal: Goal) -> Transcript:
    """Return the transcript of a goal."""
    assert isinstance(goal.run, Transcript)
    return goal.run


def require_child(goal: Goal, step: int) -> ScriptedGoal:
    """Require that the server got as far as this step (1 to 4) of a fetch, with the right action, and return it."""
    goal.require_accepted()
    sent = children(goal)
    action = NAVIGATE if step % 2 else PICK
    if len(sent) < step:
        require_alive(goal.run)
        ended = f"; fetch ended {name_of(StatusName, goal.status)}" if goal.status else ""
        raise Failure(
            expected=f"{step} goals, the last of which {STEPS[step]}"
            if step > 1
            else f"a goal {STEPS[step]}",
            observed=f"{len(sent)} to both actions together{ended}",
            help=_why_it_stopped(goal, sent),
            at=goal.result.t if goal.result else goal.sent.t,
        )
    child = sent[step - 1]
    expect(
        child.received.action == action,
        expected=f"goal {step} {STEPS[step]}",
        observed=f"a goal to {child.received.action}",
        help="The order is: to the table, take the object, home, put it down.",
        at=child.received.t,
    )
    return child


def _why_it_stopped(goal: Goal, sent: Sequence[ScriptedGoal]) -> str:
    if unmeant := why_rclpy_aborted(goal):
        return unmeant
    if goal.result and (said := goal.result.result.error_msg):
        gave_up = f"Your server gave up by itself, with error_msg {shown(said)}"
        levels = [each for each in run_of(goal).published("battery_state") if each.t <= goal.sent.t]
        if not sent and len(levels) == 1 and "battery" in said:
            return f"{gave_up}. battery_state came once, before the goal: {LATCHED}"
        return f"{gave_up}: find out why."
    if goal.result:
        return (
            "execute made its terminal call too early: go on with the next step when a child has SUCCEEDED."
        )
    if place := where_it_stood(goal.run):
        return f"execute stood in {place}. {DEAD_END}"
    if sent and sent[-1].result_sent is None and sent[-1].is_accepted:
        return "Ask for the child's result with get_result_async() once it is accepted."
    return DEAD_END


def require_walk_to_the_table(child: ScriptedGoal) -> None:
    """Require that a goal of navigate_to_pose, in odom, leads away from home."""
    away = math.dist(_place_of_walk(child, "this walk goes to the table"), HOME)
    expect(
        away >= ELSEWHERE,
        expected="the first walk to lead to the table",
        observed=f"it leads to a place {away:.2f} m from home",
        help="The first pose is TABLE.",
        at=child.received.t,
    )


def require_walk_home(child: ScriptedGoal) -> None:
    """Require that a goal of navigate_to_pose, in odom, leads home."""
    away = math.dist(_place_of_walk(child, "this walk goes home"), HOME)
    expect(
        away < ELSEWHERE,
        expected="this walk to lead home, to (0, 0) in odom",
        observed=f"it leads to a place {away:.2f} m away",
        help="The pose after the table is HOME.",
        at=child.received.t,
    )


def _place_of_walk(child: ScriptedGoal, because: str) -> tuple[float, float]:
    """Return where a goal of navigate_to_pose leads (m), which must be a whole pose in odom."""
    pose, at = child.message.pose.pose, child.received.t
    help = (
        "Fill goal.pose, a PoseStamped, from TABLE or HOME: header.frame_id, pose.position, pose.orientation."
    )
    expect_field(child.message, "pose.header.frame_id", "odom", because=because, help=help, at=at)
    rotation = pose.orientation
    expect(
        abs(math.hypot(rotation.x, rotation.y, rotation.z, rotation.w) - 1) < 0.01,
        expected="a quaternion of length 1",
        observed=f"x {rotation.x:g}, y {rotation.y:g}, z {rotation.z:g}, w {rotation.w:g}",
        help="Four zeros are no rotation: for a heading of 0, orientation.w is 1.0, as in a new message.",
        at=at,
    )
    return pose.position.x, pose.position.y


def require_pick(child: ScriptedGoal, request: Any) -> None:
    """Require that a goal of pick_and_place moves the object that was asked for, with the force that was asked for."""
    asked, at = "the goal of fetch says so", child.received.t
    help = "Copy object_id and grasp_force from goal_handle.request into the goal for pick_and_place."
    expect_field(child.message, "object_id", request.object_id, because=asked, help=help, at=at)
    expect_field(child.message, "grasp_force", request.grasp_force, because=asked, help=help, at=at)
    frame = "pick_and_place needs a frame"
    help = "Fill header.frame_id of place_pose, or copy place_pose whole."
    expect_field(child.message, "place_pose.header.frame_id", "odom", because=frame, help=help, at=at)


def require_put_aside(child: ScriptedGoal, request: Any) -> None:
    """Require that a goal of pick_and_place puts the object where the robot carries it, not at its place yet."""
    away = math.dist(_place_of_object(child.message), _place_of_object(request))
    expect(
        away >= ASIDE,
        expected="the object on the tray while the robot carries it",
        observed="place_pose of fetch's own goal, which is at home: the robot stands at the table",
        help="The first place_pose is TRAY, the second one that of fetch's own goal.",
        at=child.received.t,
    )


def require_put_down(child: ScriptedGoal, request: Any) -> None:
    """Require that a goal of pick_and_place puts the object down at the place that was asked for."""
    place = request.place_pose.pose.position
    where = "it is put down at place_pose of fetch's goal"
    help = "The first place_pose is TRAY, the second one that of fetch's own goal."
    for axis in "xyz":
        path = f"place_pose.pose.position.{axis}"
        expect_field(child.message, path, getattr(place, axis), because=where, help=help, at=child.received.t)


def _place_of_object(message: Any) -> tuple[float, float, float]:
    place = message.place_pose.pose.position
    return place.x, place.y, place.z
