"""Questions that every server is asked, whatever it serves."""

from __future__ import annotations

from typing import TypeVar

from autograder import events as ev
from autograder.checks import Failure, expect
from autograder.readiness import last_line, require_within_limits
from autograder.transcript import CallHistory, Transcript

DELIVERY = 3.0  # s a message may be on its way: 0.6 s of wall time at scale 5, on a busy machine

E = TypeVar("E", bound=ev.Event)


def require_alive(run: Transcript) -> None:
    """The student's process did not die while the scenario ran."""
    require_within_limits(run)
    exited = run.first(ev.NodeExited)
    if exited and run.first(ev.NodeSignalled) is None:
        raise Failure(
            expected="a node that keeps running",
            observed=f"the program ended with status {exited.returncode}: {last_line(run.output('stderr'))}",
            help="An exception in a callback ends rclpy.spin() and with it the node: find it in the log below.",
            at=exited.t,
        )


def require_answer(run: Transcript, call: CallHistory) -> ev.ServiceAnswered:
    """Return the answer to a service call, which must have come."""
    if call.answer is None:
        require_alive(run)
        raise Failure(
            expected=f"an answer to {call.sent.service}",
            observed="none within 5 s",
            help="The callback must return the response at once: it may not wait, sleep or call another "
            "service while the node has only one thread.",
            at=call.sent.t,
        )
    return call.answer


def last_messages(run: Transcript, kind: type[E], call: CallHistory) -> list[E]:
    """Return what may be 'the last message' at a server that answered `call`, oldest first.

    That is the newest at the request, those still on their way, and those that came before the answer.
    """
    assert call.answer is not None
    published = run.all(kind)
    before = [message for message in published if message.t <= call.sent.t - DELIVERY]
    around = [message for message in published if call.sent.t - DELIVERY < message.t <= call.answer.t]
    return before[-1:] + around


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
    signalled = run.first(ev.NodeSignalled)
    assert signalled is not None
    exited = run.first(ev.NodeExited)
    expect(
        exited is not None,
        expected="the program to end after SIGINT (Ctrl-C)",
        observed=f"it still ran {run.end - signalled.t:.1f} s later",
        help="Something keeps the process alive: a loop that does not look at rclpy.ok(), or a thread that is "
        "not a daemon. " + _CLEAN_END,
        at=signalled.t,
    )
    assert exited is not None
    last_words = last_line(run.output("stderr"))
    expect(
        exited.returncode == 0,
        expected="exit status 0 after SIGINT (Ctrl-C)",
        observed=f"exit status {exited.returncode}: {last_words or 'nothing on stderr'}",
        help=next((reason for sign, reason in _REASONS.items() if sign in last_words), _CLEAN_END),
        at=exited.t,
    )
