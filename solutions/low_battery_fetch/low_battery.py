"""What a fetch makes of a battery that drops while something is under way."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure, expect
from autograder.authoring.goal import SUCCEEDED, Goal
from autograder.authoring.missing import unseen
from autograder.authoring.scripted_goal import ScriptedGoal
from autograder.authoring.transcript import Transcript
from ros_runtime.message_constants import GoalStatus as StatusName
from ros_runtime.message_constants import name_of

from .child_endings import (
    end_of,
    require_child_canceled,
    require_finished,
    require_in_order,
    require_no_more,
    require_not_canceled,
    require_nothing_left,
)
from .children import BATTERY, NAVIGATE, children, require_child, require_walk_home, run_of
from .fetch_endings import require_abort


def require_drop(run: Transcript) -> ev.MessagePublished:
    """Require that a low level was published, and heard; return the first."""
    for event in run.published(BATTERY):
        if 0.0 <= event.message.percentage < 0.20:
            expect(
                event.subscriptions > 0,
                expected=f"a subscription of {BATTERY} while the node runs",
                observed="none",
                help=f'create_subscription(BatteryState, "{BATTERY}", …): a relative name, and TRANSIENT_LOCAL.',
                at=event.t,
            )
            return event
    if early := run.goal("fetch").result:
        raise Failure(
            expected="the fetch under way until the battery drops",
            observed=f"it ended {name_of(StatusName, early.status)} before that",
            help="Make the terminal call only when the last child has ended.",
            at=early.t,
        )
    raise unseen(run, "no low level of the battery was published")


def require_at_work(run: Transcript, child: ScriptedGoal, moment: float, what: str) -> None:
    """Require, of the arena, that a child was at work at a moment (s)."""
    end = end_of(child, run)
    if not child.is_accepted or child.received.t > moment or (end is not None and end < moment):
        raise unseen(run, f"{child.received.action} was not at work when {what}")


def require_stage(run: Transcript, child: ScriptedGoal, moment: float, stage: str) -> None:
    """Require, of the arena, that the last stage the arm had published before a moment (s) was this one."""
    said = [event.feedback.stage for event in child.feedback if event.t < moment]
    if not said or said[-1] != stage:
        raise unseen(run, f"pick_and_place was not {stage}")


def require_gave_up_before_the_grasp(goal: Goal, step: int) -> None:
    """Require that the drop canceled the child of a step, that the robot went home, and ABORTED naming the battery."""
    run = run_of(goal)
    child = require_child(goal, step)
    drop = require_drop(run)
    require_at_work(run, child, drop.t, "the battery dropped")
    because = f"the battery fell to {drop.message.percentage:.2f} and nothing is held"
    require_child_canceled(goal, child, drop.t, because)
    require_in_order(goal)
    if step < 4:
        require_home_after(goal, step, because)
        require_no_more(goal, step + 1, "the robot is home")
    else:
        require_no_more(goal, step, "the robot is home already")
    require_abort(goal, "battery", because=because)
    require_nothing_left(goal)


def require_home_after(goal: Goal, step: int, because: str) -> ScriptedGoal:
    """Require that the next child after a step walked home, and was left to arrive although the battery is low."""
    sent = children(goal)
    expect(
        len(sent) > step,
        expected=f"a walk home, because {because}",
        observed=f"none; fetch ended {name_of(StatusName, goal.status)}" if goal.status else "none",
        help="When the child that you canceled has ended, send HOME to navigate_to_pose before you abort.",
        at=goal.result.t if goal.result else goal.run.end,
    )
    home = sent[step]
    expect(
        home.received.action == NAVIGATE,
        expected=f"a walk home, because {because}",
        observed=f"a goal to {home.received.action}",
        help="When the child has ended and the battery is low, the next goal is HOME, for navigate_to_pose.",
        at=home.received.t,
    )
    require_walk_home(home)
    require_not_canceled(
        home,
        "it brings the robot home",
        "The battery stays low on the way home: look at it no more once you have given up.",
    )
    require_finished(goal, home, SUCCEEDED)
    return home
