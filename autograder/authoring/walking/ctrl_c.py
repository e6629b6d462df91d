"""Judges a client of `walk_to` after Ctrl-C: that it cancelled its goal, waited for the end, and said so."""

from __future__ import annotations

import re

from action_msgs.msg import GoalStatus

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    require_cancel,
    require_exit,
    require_goal_answered,
    require_goal_finished,
    require_one_goal,
)
from autograder.authoring.failure import expect
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import CANCELED, PATIENCE, STATUS_HELP, WALK

_ENDING = re.compile(r"cancel|interrupt|ctrl|stop|succe|arriv|abort", re.IGNORECASE)


def require_interrupted(run: Transcript) -> float:
    """Require that Ctrl-C was pressed while the goal was under way, and return when (s)."""
    signalled = run.first(ev.NodeSignalled)
    if signalled is None:
        raise unseen(run, "Ctrl-C was not pressed, because the goal never was under way")
    return signalled.t


def require_canceled_by_ctrl_c(run: Transcript, within: float) -> None:
    """Require that Ctrl-C, and nothing before it, cancelled the goal, and that the program followed it to its end."""
    goal = require_one_goal(run, WALK)
    pressed = require_interrupted(run)
    cancel = require_cancel(
        run,
        goal,
        because="you pressed Ctrl-C",
        help="rclpy shuts down at Ctrl-C, and then nothing can be sent: rclpy.init(signal_handler_options="
        "SignalHandlerOptions.NO), catch the signal yourself, and call cancel_goal_async().",
    )
    expect(
        cancel.received.t >= pressed,
        expected="the goal to go on until Ctrl-C",
        observed=f"a request to cancel {pressed - cancel.received.t:.1f} s before",
        help="Cancel only when Ctrl-C is pressed, or when nothing has been heard for 5 s.",
        at=cancel.received.t,
    )
    finished = require_goal_finished(run, goal, GoalStatus.STATUS_CANCELED)
    exited = require_exit(
        run, within, CANCELED, because="the goal was CANCELED by Ctrl-C", stream="stdout", help=STATUS_HELP
    )
    _require_ending_told(run, exited, pressed=pressed, ended=finished.t)


def require_end_after_ctrl_c(run: Transcript, within: float) -> None:
    """Require status 4 within 5 s of Ctrl-C, whatever becomes of the goal."""
    goal = require_one_goal(run, WALK)
    pressed = require_interrupted(run)
    require_goal_answered(run, goal, accepted=True)
    if not goal.cancels:
        raise unseen(run, "the goal was not cancelled")
    exited = require_exit(
        run,
        pressed + within,
        CANCELED,
        because="Ctrl-C was pressed",
        stream="stdout",
        help="Wait for the result at most 5 s after the cancel, then print a line and return 4, whatever the status of "
        "the goal: you interrupted the program.",
    )
    _require_ending_told(run, exited, pressed=pressed, ended=pressed)
    expect(
        exited.t - pressed <= PATIENCE + 2.0,
        expected=f"the end within {PATIENCE:g} s of Ctrl-C",
        observed=f"{exited.t - pressed:.1f} s after it",
        help="Wait for the result at most 5 s after the cancel, then print a line and return 4.",
        at=exited.t,
    )


def _require_ending_told(run: Transcript, exited: ev.NodeExited, *, pressed: float, ended: float) -> None:
    """Require a line on stdout that says in whatever words how it ended: after the goal's end (s), or the last one."""
    lines = [
        event
        for event in run.all(ev.NodeOutput)
        if event.stream == "stdout" and event.text.strip() and event.t >= pressed - 0.1
    ]
    expect(
        any(_ENDING.search(line.text) for line in lines if line.t >= ended - 0.1 or line is lines[-1]),
        expected="a line on stdout at the end that says how it ended, such as CANCELED",
        observed=f"the last line on stdout after Ctrl-C: {lines[-1].text if lines else 'none'}",
        help="After Ctrl-C, too, print a line when the goal has ended, or when you have waited long enough.",
        at=exited.t,
    )
