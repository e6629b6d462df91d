"""What students can see being checked."""

from __future__ import annotations

import math

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    require_goal_answered,
    require_goal_finished,
    require_no_cancel,
    require_one_goal,
)
from autograder.authoring.checks import Failure, check, expect, program
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    ABORTED,
    FINDING,
    NO_SERVER,
    PATIENCE,
    REJECTED,
    STATUS_HELP,
    require_ending_line,
    require_failure,
    require_reason,
    require_usage,
)
from autograder.authoring.walking.ctrl_c import require_interrupted

from .judging import (
    BATTERY,
    GIVING_UP,
    NAVIGATE,
    WITHIN,
    GoalStatus,
    require_canceled,
    require_drop,
    require_end_after,
    require_goal_at,
    require_level,
    require_no_goal,
    require_one_cancel,
    require_one_warning,
    require_patience,
    require_success,
    require_undisturbed_success,
    standing_at,
)

GOOD = program("good", {"arguments": ["1.5", "-0.5", "0.4"], "levels": [0.71, 0.55, 0.32]})
TOO_FEW = program("without_node", {"arguments": ["1.5"]})
NO_NUMBER = program("without_node", {"arguments": ["1.5", "left"]})
LOW_BEFORE = program("low_before", {"level": 0.12})
WITHOUT_BATTERY = program("without_battery")
NOBODY = program("nobody")
REJECTING = program("rejecting")
ABORTING = program("aborting", {"error_code": 3, "error_msg": "the way took longer than 52 s"})
DROP = program("dropping", {"levels": [0.31, 0.19, 0.18, 0.17], "ends_after": 0.6, "stands_after": 2.6})
NO_PERCENTAGE = program(
    "good", {"arguments": ["1.5", "-0.5", "0.4"], "levels": [math.nan, 20.0, 15.0, math.nan, -0.3]}
)
INTERRUPTED = program("interrupted")


AT_ONCE = 1.0  # s
LOOKS_AWAY = (
    "Look at the battery while you wait for the result: spin in short pieces, and after each compare the last "
    "percentage with 0.20."
)


@check(points=2, on=GOOD, see="06_walk_to_a_pose#client-intro", clauses=[4])
def sends_the_goal(run: Transcript) -> None:
    """With the battery at 0.80 it sends one goal, at x, y and yaw in frame odom"""
    require_level(run, low=False)
    require_goal_at(run, 1.5, -0.5, 0.4)


@check(points=2, on=GOOD, needs=sends_the_goal, see="06_walk_to_a_pose#follow-task", clauses=[5, 12])
def says_how_it_succeeded(run: Transcript) -> None:
    """A goal that SUCCEEDED while the battery lasts is not cancelled, and ends it with status 0"""
    require_no_cancel(require_success(run), because="the battery never falls below 0.32")


@check(
    points=1,
    on=[TOO_FEW, NO_NUMBER],
    needs=says_how_it_succeeded,
    see="03_clients_that_survive#fix-frame",
    clauses=[17],
)
def refuses_wrong_arguments(too_few: Transcript, no_number: Transcript) -> None:
    """Wrong arguments end it with status 2 and the usage, before a node is started"""
    for run in (too_few, no_number):
        require_usage(run, WITHIN)


@check(points=1, on=NOBODY, see="03_clients_that_survive#fix-why", clauses=[2, 15])
def gives_up_without_a_server(run: Transcript) -> None:
    """Without a server it ends with status 1 after 5 s, and says so on stderr"""
    require_level(run, low=False)
    if run.first(ev.ActionOffered):
        raise unseen(run, f"{NAVIGATE} was offered")
    require_failure(
        run,
        GIVING_UP,
        NO_SERVER,
        because=f"nobody offers {NAVIGATE}",
        help="Look at server_is_ready() for at most 5 s, then print a line and return 1.",
    )
    ready = run.first(ev.NodeReady)
    if ready is None:
        raise unseen(run, "the program's node never appeared")
    require_patience(
        run, ready.t, what="a server that takes a while to be found", help="Wait for the server up to 5 s."
    )


@check(
    points=1,
    on=[REJECTING, ABORTING],
    needs=says_how_it_succeeded,
    see="06_walk_to_a_pose#hopeful-why",
    clauses=[12, 13, 15],
)
def says_how_it_failed(rejected: Transcript, aborted: Transcript) -> None:
    """A rejected goal ends it with status 2, an aborted one with 3 and error_msg on stderr"""
    require_goal_answered(rejected, require_one_goal(rejected, NAVIGATE), accepted=False)
    require_failure(
        rejected,
        WITHIN,
        REJECTED,
        because="the goal was rejected",
        help="Look at goal_handle.accepted before you ask for the result: a rejected goal has none.",
    )
    finished = require_goal_finished(aborted, require_one_goal(aborted, NAVIGATE), GoalStatus.STATUS_ABORTED)
    require_failure(aborted, WITHIN, ABORTED, because="the goal was ABORTED", help=STATUS_HELP)
    require_reason(aborted, finished)


@check(points=2, on=LOW_BEFORE, needs=says_how_it_succeeded, see="08_navigation#guard-intro", clauses=[3])
def does_not_set_out_on_a_low_battery(run: Transcript) -> None:
    """With a latched battery_state of 0.12 it sends no goal, says so on stdout, and ends with status 4"""
    low = [event for event in run.published(BATTERY) if event.message.percentage < 0.2]
    if not low:
        raise unseen(run, "no low level of the battery was published")
    require_no_goal(
        run,
        "the battery is at 0.12",
        "Look at the last percentage before you send the goal: below 0.20, print a line and return 4.",
    )
    exited, ready = run.first(ev.NodeExited), run.first(ev.NodeReady)
    if exited and ready and exited.returncode == NO_SERVER and exited.t - ready.t > PATIENCE - FINDING:
        raise Failure(
            expected="exit status 4: the battery is at 0.12",
            observed=f"exit status 1; the last line on stderr: {run.last_words or 'none'}",
            help=f"{BATTERY} was published once, before your program began. A subscription gets that message only with "
            "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL).",
            at=exited.t,
        )
    exited = require_canceled(run, WITHIN, "the battery is at 0.12")
    expect(
        "battery" in run.output("stdout").lower(),
        expected="a line on stdout that names the battery as the reason",
        observed=f"“{run.output('stdout')[:200]}”",
        help="Say why there was no walk: print a line with the word battery.",
        at=exited.t,
    )


@check(
    points=1,
    on=WITHOUT_BATTERY,
    needs=says_how_it_succeeded,
    see="08_navigation#guard-intro",
    clauses=[1, 15],
)
def does_not_set_out_without_a_battery_state(run: Transcript) -> None:
    """Without any battery_state in 5 s it sends no goal and ends with status 1"""
    if run.published(BATTERY):
        raise unseen(run, f"{BATTERY} was published")
    require_no_goal(
        run,
        f"nothing is known of the battery, as no {BATTERY} came",
        f"Wait for the first {BATTERY} before you send the goal: an unknown battery is no full one.",
    )
    require_failure(
        run,
        GIVING_UP,
        NO_SERVER,
        because=f"no {BATTERY} came",
        help=f"Wait for the first {BATTERY} at most 5 s, then print a line on stderr and return 1.",
    )
    ready = run.first(ev.NodeReady)
    if ready is None:
        raise unseen(run, "the program's node never appeared")
    require_patience(
        run,
        ready.t,
        what=BATTERY,
        help="One spin is not enough: spin until a message has come, or 5 s are over.",
    )


@check(points=2, on=DROP, needs=says_how_it_succeeded, see="08_navigation#watch-run", clauses=[5])
def cancels_when_the_battery_drops(run: Transcript) -> None:
    """When the percentage falls below 0.20 on the way, it cancels the goal within 1 s, once"""
    goal = require_one_goal(run, NAVIGATE)
    require_goal_answered(run, goal, accepted=True)
    drop = require_drop(run)
    require_one_cancel(
        run, drop.t, AT_ONCE, because=f"the battery fell to {drop.message.percentage:.2f}", help=LOOKS_AWAY
    )


@check(points=2, on=DROP, needs=cancels_when_the_battery_drops, see="08_navigation#standing-why", clauses=[9])
def waits_until_the_robot_stands(run: Transcript) -> None:
    """After the cancel it waits for CANCELED and for robot_state STANDING, then ends with status 4"""
    goal = require_one_goal(run, NAVIGATE)
    finished = require_goal_finished(run, goal, GoalStatus.STATUS_CANCELED)
    standing = standing_at(run)
    exited = run.first(ev.NodeExited)
    if standing is None or (exited and exited.t < standing):
        if exited is None:
            raise unseen(run, "the robot never stood")
        raise Failure(
            expected="the end only when the goal is CANCELED and the robot stands",
            observed=f"it ended {exited.t - finished.t:.1f} s after CANCELED, while robot_state said WALKING",
            help="The result tells how the goal ended; what the legs do, robot_state tells. Spin until its last mode "
            "is RobotState.STANDING, at most 5 s. That it stood before the walk does not count.",
            at=exited.t,
        )
    exited = require_canceled(run, standing + WITHIN, "the battery was low and the goal was CANCELED")
    require_end_after(
        run,
        standing,
        AT_ONCE,
        what="robot_state STANDING",
        help="Wait for robot_state STANDING before you return.",
    )
    require_ending_line(run, "CANCELED", exited.t)


@check(
    points=2, on=NO_PERCENTAGE, needs=says_how_it_succeeded, see="08_navigation#guard-traps-why", clauses=[8]
)
def ignores_what_is_no_percentage(run: Transcript) -> None:
    """NaN, 20.0, 15.0 and -0.3 on the way are ignored, with one warning line on stderr"""
    goal = require_one_goal(run, NAVIGATE)
    require_goal_answered(run, goal, accepted=True)
    exited = run.first(ev.NodeExited)
    strange = [event for event in run.published(BATTERY) if not 0.0 <= event.message.percentage <= 1.0]
    if not any(exited is None or event.t < exited.t for event in strange):
        raise unseen(run, "nothing but percentages was published")
    require_undisturbed_success(run)
    if len([event for event in strange if goal.finished and event.t < goal.finished.t]) < 2:
        raise unseen(run, "the goal ended before anything but percentages was published")
    require_one_warning(run)


@check(points=1, on=INTERRUPTED, needs=says_how_it_succeeded, see="06_walk_to_a_pose#field-why", clauses=[16])
def ctrl_c_cancels_the_goal(run: Transcript) -> None:
    """Ctrl-C cancels the goal; it waits for its end and ends with status 4"""
    goal = require_one_goal(run, NAVIGATE)
    pressed = require_interrupted(run)
    require_one_cancel(
        run,
        pressed,
        AT_ONCE,
        because="you pressed Ctrl-C",
        help="rclpy shuts down at Ctrl-C, and then nothing can be sent: rclpy.init(signal_handler_options="
        "SignalHandlerOptions.NO), catch the signal yourself, and call cancel_goal_async().",
    )
    require_goal_finished(run, goal, GoalStatus.STATUS_CANCELED)
    require_canceled(run, pressed + WITHIN, "the goal was CANCELED by Ctrl-C")
