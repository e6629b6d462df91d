"""Judges a run of the battery guard."""

from __future__ import annotations

import math
import re

from action_msgs.msg import GoalStatus

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    require_exit,
    require_goal_answered,
    require_goal_finished,
    require_one_goal,
    require_single_cancel,
)
from autograder.authoring.client_checks import SLACK
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import expect_field, shown
from autograder.authoring.missing import unseen
from autograder.authoring.scripted_goal import ScriptedCancel, ScriptedGoal
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    CANCELED,
    FINDING,
    PATIENCE,
    STATUS_HELP,
    SUCCEEDED,
    require_ending_line,
)
from humanoid_interfaces.msg import RobotState

NAVIGATE = "navigate_to_pose"
BATTERY = "battery_state"
ROBOT = "robot_state"
LOW = 0.20
WITHIN = 10.0  # s for a walk of a second or two
GIVING_UP = 8.0  # s, of which 5 are waited


# -- what was played --------------------------------------------------------------------------------------------------


def is_low(level: float) -> bool:
    """Return whether a percentage, a float32, is one and below the limit."""
    return 0.0 <= level < LOW


def require_level(run: Transcript, *, low: bool) -> ev.MessagePublished:
    """Require that a low level, or one that is not, was published while the client was there; return the first."""
    exited = run.first(ev.NodeExited)
    for event in run.published(BATTERY):
        if is_low(event.message.percentage) == low and (exited is None or event.t < exited.t):
            return event
    raise unseen(run, f"no {'low' if low else 'high'} level of the battery was published")


def require_drop(run: Transcript) -> ev.MessagePublished:
    """Require that a low level was published to the client, which listened; return the first."""
    drop = require_level(run, low=True)
    expect(
        drop.subscriptions > 0,
        expected=f"a subscription of {BATTERY} as long as the goal runs",
        observed="none",
        help=f'create_subscription(BatteryState, "{BATTERY}", …): a relative name, and keep it until the end.',
        at=drop.t,
    )
    return drop


def standing_at(run: Transcript) -> float | None:
    """Return when (s) the robot last began to stand; None: it does not."""
    modes = run.published(ROBOT)
    if not modes:
        raise unseen(run, f"{ROBOT} was not published")
    return modes[-1].t if modes[-1].message.mode == RobotState.STANDING else None


# -- what the client did ----------------------------------------------------------------------------------------------


def require_goal_at(run: Transcript, x: float, y: float, yaw: float) -> ScriptedGoal:
    """Require one goal at a pose (m, m, rad) in odom."""
    goal = require_one_goal(run, NAVIGATE)
    at = goal.received.t
    because = f"the program was started with {' '.join(run.params['arguments'])}"
    for path, value in (("pose.pose.position.x", x), ("pose.pose.position.y", y)):
        help = f"Set goal.{path} from the arguments, in metres."
        expect_field(goal.message, path, value, because=because, help=help, at=at)
    expect_field(
        goal.message,
        "pose.header.frame_id",
        "odom",
        because="a pose means nothing without its frame",
        help='Set goal.pose.header.frame_id = "odom".',
        at=at,
    )
    rotation = goal.message.pose.pose.orientation
    heading = 2 * math.atan2(rotation.z, rotation.w)
    length = math.hypot(rotation.x, rotation.y, rotation.z, rotation.w)
    expect(
        abs(math.remainder(heading - yaw, math.tau)) < 0.01 and abs(length - 1.0) < 0.01,
        expected=f"a quaternion that turns by {yaw:g} rad about z",
        observed=f"x {rotation.x:.3f}, y {rotation.y:.3f}, z {rotation.z:.3f}, w {rotation.w:.3f}",
        help="orientation.z = math.sin(yaw / 2) and orientation.w = math.cos(yaw / 2); without a yaw, w is 1.0.",
        at=at,
    )
    return goal


def require_success(run: Transcript, within: float = WITHIN) -> ScriptedGoal:
    """Require that the goal succeeded, and exit status 0 with one line on stdout that holds SUCCEEDED."""
    goal = require_one_goal(run, NAVIGATE)
    require_goal_answered(run, goal, accepted=True)
    require_goal_finished(run, goal, GoalStatus.STATUS_SUCCEEDED)
    exited = require_exit(
        run, within, SUCCEEDED, because="the goal SUCCEEDED", stream="stdout", help=STATUS_HELP
    )
    require_ending_line(run, "SUCCEEDED", exited.t)
    return goal


def require_undisturbed_success(run: Transcript) -> None:
    """Require success without a request to cancel, whatever the battery said."""
    goal = require_one_goal(run, NAVIGATE)
    if goal.cancels:
        asked = goal.cancels[0].received.t
        said = [event.message.percentage for event in run.published(BATTERY) if event.t < asked]
        raise Failure(
            expected="no request to cancel: no percentage was below 0.20",
            observed=f"one came when the percentage was {_exactly(said[-1])}",
            help=_about_level(said[-1]),
            at=asked,
            see=_lesson_about(said[-1]),
        )
    require_success(run)


def require_one_cancel(
    run: Transcript, since: float, within: float, *, because: str, help: str
) -> ScriptedCancel:
    """Require that the client asked to cancel its goal once, soon (s) after a moment (s)."""
    goal = require_one_goal(run, NAVIGATE)
    require_goal_answered(run, goal, accepted=True)
    if not goal.cancels:
        exited = run.first(ev.NodeExited)
        gone = f"none; the program ended at {exited.t:.1f} s" if exited else "none: the robot walks on"
        raise Failure(
            expected=f"a request to cancel the goal: {because}", observed=gone, help=help, at=run.end
        )
    cancel = goal.cancels[0]
    expect(
        cancel.received.t >= since,
        expected=f"no request to cancel before {because}",
        observed=f"one {since - cancel.received.t:.1f} s before",
        help="Cancel only for a percentage below 0.20, for Ctrl-C, or when nothing was heard for 5 s.",
        at=cancel.received.t,
    )
    expect(
        cancel.received.t - since <= within + SLACK,
        expected=f"a request to cancel within {within:g} s: {because}",
        observed=f"{cancel.received.t - since:.1f} s after it",
        help="Look at the battery each time that it is published, or at least ten times a second.",
        at=cancel.received.t,
    )
    return require_single_cancel(run, goal, because=because, help=help)


def require_canceled(run: Transcript, within: float, because: str) -> ev.NodeExited:
    """Require exit status 4, in time, with a line on stdout."""
    return require_exit(run, within, CANCELED, because=because, stream="stdout", help=STATUS_HELP)


def require_no_goal(run: Transcript, because: str, help: str) -> None:
    """Require that no goal was sent."""
    goals = run.scripted_goals(NAVIGATE)
    if goals:
        raise Failure(
            expected=f"no goal: {because}", observed="a goal was sent", help=help, at=goals[0].received.t
        )


def require_end_after(run: Transcript, since: float, within: float, *, what: str, help: str) -> None:
    """Require that the client ended after a moment (s), and so soon (s) after it."""
    exited = run.first(ev.NodeExited)
    if exited is None:
        return  # require_exit says more about it
    expect(
        exited.t >= since,
        expected=f"the end after {what}",
        observed=f"it ended {since - exited.t:.1f} s before",
        help=help,
        at=exited.t,
    )
    expect(
        exited.t - since <= within + SLACK,
        expected=f"the end within {within:g} s of {what}",
        observed=f"{exited.t - since:.1f} s after it",
        help="Keep the last message of robot_state, with durability transient local, and look at it again after each "
        "spin: it is published when the mode changes.",
        at=exited.t,
    )


def require_one_warning(run: Transcript) -> None:
    """Require exactly one line on stderr that warns of what is ignored."""
    lines = _lines_with(run, "stderr", r"warn|ignor")
    expect(
        len(lines) == 1,
        expected="one line on stderr with WARN or “ignored”, for all of these messages together",
        observed=f"{len(lines)}" + (": " + " | ".join(lines[:2]) if lines else ""),
        help='self.get_logger().warning("…", once=True) prints a line the first time, and nothing after that.',
        at=run.end,
    )


def require_patience(run: Transcript, since: float, *, what: str, help: str) -> None:
    """Require that the program did not end much earlier than 5 s after a moment (s)."""
    exited = run.first(ev.NodeExited)
    if exited is not None:
        expect(
            exited.t - since >= PATIENCE - FINDING,
            expected=f"{PATIENCE:g} s of patience with {what}",
            observed=f"it ended after {exited.t - since:.1f} s",
            help=help,
            at=exited.t,
        )


def _lines_with(run: Transcript, stream: str, pattern: str) -> list[str]:
    return [line for line in run.output(stream).splitlines() if re.search(pattern, line, re.IGNORECASE)]


def _exactly(level: float) -> str:
    return f"{level:.4f}" if 0.0 <= level <= 1.0 else shown(level)


def _about_level(level: float) -> str:
    if math.isnan(level):
        return "NaN says that nothing is known: it is neither low nor high. `not percentage >= 0.20` is true of it."
    if level > 1.0:
        return (
            "BatteryState.percentage runs from 0 to 1, so a publisher that counts to 100 breaks the convention. Do not "
            "guess what it means (1.0 would be 1 % or 100 %): ignore it, and warn."
        )
    if level < 0.0:
        return "A charge below 0 does not exist: ignore it, and warn."
    return (
        "Compare the number as it comes, percentage < 0.20. As a float32, 0.20 is 0.200000003: not below. Rounding it "
        "first, or a tolerance, makes another limit of it."
    )


def _lesson_about(level: float) -> str:
    return "08_navigation#float-why" if 0.0 <= level <= 1.0 else "08_navigation#guard-traps-why"
