"""A transcript as a sequence diagram: client, the student's server, the robot."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from ros_runtime.drawing.sequence_diagram import Arrow, sequence_svg
from ros_runtime.message_constants import GoalStatus, RobotMode, name_of

CLIENT, SERVER, ROBOT = "client", "server", "robot"
MODES: dict[int, str] = {
    RobotMode.OFF: "motors off",
    RobotMode.STANDING: "stands",
    RobotMode.WALKING: "walks",
    RobotMode.FALLEN: "has fallen",
}
MOST_ARROWS = 60
Feedback = ev.FeedbackReceived | ev.FeedbackSent


def transcript_svg(transcript: Transcript, title: str) -> str:
    """Draw a transcript as SVG; consecutive feedback messages are one arrow, and a long transcript is cut."""
    arrows = sorted([*_messages(transcript), *_robot(transcript)], key=lambda arrow: arrow.time)
    if len(arrows) > MOST_ARROWS:
        left_out = len(arrows) - MOST_ARROWS
        last = arrows[MOST_ARROWS - 1].time
        arrows = [*arrows[:MOST_ARROWS], Arrow(last, CLIENT, CLIENT, f"… {left_out} more")]
    return sequence_svg(arrows, title=title, participants=(CLIENT, SERVER, ROBOT))


def has_messages(transcript: Transcript) -> bool:
    """Whether anything was sent in a transcript, so that its drawing has more than notes."""
    return any(arrow.sender != arrow.receiver for arrow in _messages(transcript))


def _messages(transcript: Transcript) -> Iterator[Arrow]:
    drawn = [event for event in transcript.events if isinstance(event, Feedback) or _arrow(event)]
    for kind, group in groupby(drawn, _kind):
        events: list[Any] = list(group)
        if kind is Feedback:
            yield _feedback(events)
        elif kind is ev.Unanswered:
            yield _unanswered(events)
        else:
            yield from filter(None, map(_arrow, events))


def _kind(event: Any) -> Any:
    """Return the kind of an event if consecutive events of that kind are drawn as one arrow, else None."""
    return next((kind for kind in (Feedback, ev.Unanswered) if isinstance(event, kind)), None)


def _feedback(received: Sequence[Feedback]) -> Arrow:
    first, last = received[0], received[-1]
    rate = f" at {(len(received) - 1) / (last.t - first.t):.1f} Hz" if last.t > first.t else ""
    return Arrow(first.t, SERVER, CLIENT, f"feedback × {len(received)}{rate}", "message")


def _unanswered(given_up: Sequence[ev.Unanswered]) -> Arrow:
    """Draw consecutive unanswered requests as one arrow; when the program has ended, only the first one waited."""
    what, number = given_up[0].what, len(given_up)
    requests = f"the {what}" if number == 1 else f"{number} {what}s"
    waited = max(event.waited for event in given_up)
    return Arrow(given_up[0].t, CLIENT, CLIENT, f"no answer to {requests} after {waited:.1f} s")


def _arrow(event: object) -> Arrow | None:
    match event:
        case ev.NodeReady(t=t):
            return Arrow(t, SERVER, SERVER, "ready")
        case ev.NodeNotReady(t=t):
            return Arrow(t, SERVER, SERVER, "never offered the required endpoints")
        case ev.NodeExited(t=t, returncode=code):
            return Arrow(t, SERVER, SERVER, f"process ended with status {code}")
        case ev.NodeSignalled(t=t, signal=signal):
            return Arrow(t, CLIENT, SERVER, signal, "request")
        case ev.ServiceCalled(t=t, service=service) | ev.RequestReceived(t=t, service=service):
            return Arrow(t, CLIENT, SERVER, f"{service}?", "request")
        case ev.ServiceAnswered(t=t) | ev.ReplySent(t=t):
            return Arrow(t, SERVER, CLIENT, "response", "answer")
        case ev.GoalSent(t=t, goal=goal) | ev.GoalReceived(t=t, goal=goal):
            return Arrow(t, CLIENT, SERVER, f"goal “{goal}”", "request")
        case ev.GoalAnswered(t=t, accepted=accepted) | ev.GoalReplySent(t=t, accepted=accepted):
            return Arrow(t, SERVER, CLIENT, "accepted" if accepted else "rejected", "answer")
        case ev.CancelSent(t=t, goal=goal, by=by):
            what = f"cancel “{goal}”" if goal else f"cancel every goal (by a {by})"
            return Arrow(t, CLIENT, SERVER, what, "request")
        case ev.CancelReceived(t=t, goal=goal):
            return Arrow(t, CLIENT, SERVER, f"cancel “{goal}”" if goal else "cancel every goal", "request")
        case (
            ev.CancelAnswered(t=t, canceling=canceling, return_code=code)
            | ev.CancelReplySent(t=t, canceling=canceling, return_code=code)
        ):
            answer = "canceling" if canceling else f"cancel refused (code {code})"
            return Arrow(t, SERVER, CLIENT, answer, "answer")
        case ev.GoalFinished(t=t, goal=goal, status=status):
            return Arrow(t, SERVER, SERVER, f"“{goal}” ends {name_of(GoalStatus, status)}")
        case ev.ResultSent(t=t, goal=goal):
            return Arrow(t, SERVER, CLIENT, f"result “{goal}”", "answer")
        case ev.ResultForgotten(t=t, goal=goal):
            return Arrow(t, SERVER, SERVER, f"forgets the result of “{goal}”")
        case ev.ServiceWithdrawn(t=t, service=name) | ev.ActionWithdrawn(t=t, action=name):
            return Arrow(t, SERVER, SERVER, f"the server of {name} dies")
        case ev.MessagePublished(t=t, topic=topic):
            return Arrow(t, SERVER, CLIENT, f"a message on {topic}", "message")
        case ev.NodeTyped(t=t, line=line):
            return Arrow(t, CLIENT, CLIENT, "stdin ends" if line is None else f"typed: {line}")
        case ev.ResultReceived(t=t, goal=goal, status=status):
            return Arrow(t, SERVER, CLIENT, f"result “{goal}”: {name_of(GoalStatus, status)}", "answer")
        case ev.Unanswered():
            return _unanswered([event])
        case ev.RobotCommanded(t=t, verb=verb):
            return Arrow(t, ROBOT, ROBOT, f"the grader: {verb}")
    return None


def _robot(transcript: Transcript) -> Iterator[Arrow]:
    mode: int | None = None
    for robot in transcript.ground_truth:
        if robot.mode != mode:
            mode = robot.mode
            yield Arrow(robot.t, ROBOT, ROBOT, MODES.get(mode, str(mode)))
