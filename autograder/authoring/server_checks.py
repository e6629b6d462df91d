"""Questions that every server is asked, whatever it serves."""

from __future__ import annotations

from typing import TypeVar

from autograder.authoring import events as ev
from autograder.authoring.checks import Failure, expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.readiness import require_within_limits
from autograder.authoring.transcript import CallHistory, Transcript

# s a message may be on its way: 0.2 s of wall time at scale 5, 0.1 s at scale 10. Scenarios wait a little longer.
DELIVERY = 1.0

E = TypeVar("E", bound=ev.Event)


def require_alive(run: Transcript) -> None:
    """The student's process did not die while the scenario ran."""
    require_within_limits(run)
    exited = run.first(ev.NodeExited)
    if exited and run.first(ev.NodeSignalled) is None:
        raise Failure(
            expected="a node that keeps running",
            observed=f"the program ended with status {exited.returncode}: {run.last_words}",
            help="An exception in a callback ends rclpy.spin() and with it the node: find it in the log below.",
            at=exited.t,
        )


def require_answer(run: Transcript, call: CallHistory) -> ev.ServiceAnswered:
    """Return the answer to a service call, which must have come while it was waited for."""
    if call.answer is None:
        require_alive(run)
        given_up = next((event for event in run.all(ev.Unanswered) if event.id == call.name), None)
        waited = given_up.waited if given_up else run.end - call.sent.t
        raise Failure(
            expected=f"an answer to {call.sent.service}",
            observed=f"none within {waited:.0f} s",
            help="The callback must return the response at once: it may not wait, sleep or call another "
            "service while the node has only one thread.",
            at=call.sent.t,
        )
    return call.answer


def last_messages(run: Transcript, kind: type[E], call: CallHistory, *, since: float) -> list[E]:
    """Return what may be 'the last message' at a server that answered `call`, oldest first.

    That is the newest at the request, what it may not have taken the place of yet, since it was still on its way, and
    what came before the answer. A message sent after `since` (s) must have had the time to arrive: it is the stimulus.
    """
    answer = require_answer(run, call)
    published = [message for message in run.all(kind) if message.t <= answer.t]
    arrived = [message for message in published if message.t <= call.sent.t - DELIVERY]
    if not arrived or arrived[-1].t <= since:
        raise unseen(run, f"the robot published nothing in time for {call.name} to {call.sent.service}")
    return published[len(arrived) - 1 :]


def require_calls(run: Transcript, number: int) -> list[CallHistory]:
    """Return every call of the scenario, of which there must be `number`, each answered."""
    for call in run.calls:
        require_answer(run, call)
    if len(run.calls) < number:
        raise Missing(
            run,
            expected=f"answers to {number} requests",
            never=f"only {len(run.calls)} of {number} were sent",
        )
    return run.calls


_CLEAN_END = (
    "Catch KeyboardInterrupt and ExternalShutdownException around spin(), destroy the node and call "
    "rclpy.try_shutdown() in a finally block."
)
# What the last line on stderr says about why a program did not end with status 0.
_REASONS = {
    "rcl_shutdown already called": "Ctrl-C has shut rclpy down already, so rclpy.shutdown() raises: call "
    "rclpy.try_shutdown() instead.",
    "KeyboardInterrupt": "Nothing catches the KeyboardInterrupt that Ctrl-C raises. " + _CLEAN_END,
    "ExternalShutdownException": "spin() reports Ctrl-C in two ways, as KeyboardInterrupt or as "
    "ExternalShutdownException: catch both.",
}


def require_clean_exit(run: Transcript) -> None:
    """SIGINT ended the process with status 0.

    Output is not judged: rclpy prints tracebacks of its own when Ctrl-C meets one of its threads.
    """
    require_within_limits(run)
    signalled = run.first(ev.NodeSignalled)
    if signalled is None:
        raise unseen(run, "nobody pressed Ctrl-C")
    exited = run.first(ev.NodeExited)
    if exited is None:
        raise Failure(
            expected="the program to end after SIGINT (Ctrl-C)",
            observed=f"it still ran {run.end - signalled.t:.1f} s later",
            help="Something keeps the process alive: a loop that does not look at rclpy.ok(), or a thread that is "
            "not a daemon. " + _CLEAN_END,
            at=signalled.t,
        )
    expect(
        exited.t >= signalled.t,
        expected="a node that runs until Ctrl-C",
        observed=f"it had ended before, with status {exited.returncode}: {run.last_words or 'nothing on stderr'}",
        help="An exception in a callback ends rclpy.spin() and with it the node: find it in the log below.",
        at=exited.t,
    )
    last_words = run.last_words
    expect(
        exited.returncode == 0,
        expected="exit status 0 after SIGINT (Ctrl-C)",
        observed=f"exit status {exited.returncode}: {last_words or 'nothing on stderr'}",
        help=next((reason for sign, reason in _REASONS.items() if sign in last_words), _CLEAN_END),
        at=exited.t,
    )
