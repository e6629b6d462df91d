"""Compares an answer of the joint query with the request and with what the robot published."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.connections import lesson_on_hearing, why_nothing_is_heard
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import shown_fields
from autograder.authoring.missing import unseen
from autograder.authoring.robot_record import RobotRecord
from autograder.authoring.robot_topic import last_messages
from autograder.authoring.transcript import Transcript

MOVED = 0.1  # rad that a joint may be off where it was told to be, under its load
TOLERANCE = 0.01  # rad; the robot itself gives by half as much while it settles in its stance

_NOT_HEARD = (
    "Subscribe to joint_states: compare the name (relative) and the type letter by letter, and give "
    "qos_profile_sensor_data. The robot publishes best effort, which a reliable subscription never gets."
)

Positions = Mapping[str, float]  # rad, by the joint's name


def not_heard(run: RobotRecord) -> str:
    """Return why no joint_states reach the node, as far as the grader saw."""
    return why_nothing_is_heard(run, "joint_states") or _NOT_HEARD


def require_posture(call: Call, posture: Positions) -> None:
    """Require that the scenario moved the joints, and published them where they are now, in time for the call."""
    told = call.run.told("move_joints", before=call.sent.t, positions=dict(posture))
    messages = last_messages(call, ev.JointsPublished, since=told.t)
    reached = _positions(messages[0])
    away = {name: reached.get(name, math.inf) - angle for name, angle in posture.items()}
    name = max(away, key=lambda joint: abs(away[joint]))
    expect(
        abs(away[name]) <= MOVED,
        expected=f"the robot's {name} at {posture[name]:.2f} rad, where it was told to be",
        observed=f"it is {abs(away[name]):.2f} rad off",
        help="Publish nothing: a node that answers questions about the joints must not move them.",
        at=messages[0].t,
    )


def require_reversed(call: Call) -> None:
    """Require that the robot listed its joints in the other order, in time for the call."""
    told = call.run.told("joint_states", before=call.sent.t, reversed=True)
    messages = last_messages(call, ev.JointsPublished, since=told.t)
    before = [message for message in call.run.all(ev.JointsPublished) if message.t <= told.t]
    if not before or messages[0].names == before[0].names:
        raise unseen(call.run, "the robot never listed its joints in another order")


def listed(words: Sequence[str], most: int = 8) -> str:
    """Join at most `most` words, without control characters; say so if there are none."""
    shown = [word[:60] if word.isprintable() else repr(word[:60]) for word in words[:most]]
    rest = [f"and {len(words) - most} more"] if len(words) > most else []
    return ", ".join(shown + rest) or "no names"


def robot_joints(run: Transcript) -> list[str]:
    """Return the names of the joints that the robot published, which the node must have listened to."""
    published = run.first(ev.JointsPublished)
    if published is None:
        raise Failure(
            expected="a node that listens to joint_states",
            observed="an answer without it: no message of joint_states has reached your node",
            help=not_heard(run),
            see=lesson_on_hearing(run, "joint_states"),
        )
    return published.names


def require_success(call: Call) -> None:
    """Require that it answered success, since every joint asked for exists."""
    heard = call.run.first(ev.JointsPublished) is not None
    expect(
        call.response.success,
        expected=f"success: true for {listed(call.request.names)}, which the robot has",
        observed=shown_fields(call.response, "success", "message"),
        help=_advice_on_refusal(call) if heard else not_heard(call.run),
        at=call.answered.t,
        see=lesson_on_hearing(call.run, "joint_states"),
    )


def _advice_on_refusal(call: Call) -> str:
    """Say what is wrong about a refusal of joints that exist, though joint_states arrives."""
    message, asked = call.response.message, call.run.all(ev.ServiceCalled)
    earlier = [name for other in asked if other.t < call.sent.t for name in other.request.names]
    left = [name for name in earlier if name in message and name not in call.request.names]
    if left:
        return f"The message names {left[0]}, of an earlier request: begin a new list of unknown names in each request."
    answers = call.run.all(ev.ServiceAnswered)
    if any(answer.t < call.sent.t and answer.response.message == message for answer in answers):
        return "joint_states has arrived since your last refusal: look at each request whether there is a message."
    return "Look up each name in the name list of the last joint_states, and set success when all are there."


def require_refusal(call: Call, *, because: str, help: str) -> None:
    """Require that it answered success: false."""
    expect(
        not call.response.success,
        expected=f"success: false for {listed(call.request.names)}, because {because}",
        observed=shown_fields(call.response, "success", "message"),
        help=help,
        at=call.answered.t,
    )


def require_names(call: Call) -> None:
    """Require that the answer lists the joints asked for, in the order of the request."""
    names, wanted = call.response.joint_state.name, call.request.names
    expect(
        names == wanted,
        expected=f"joint_state.name as asked: {listed(wanted)}",
        observed=listed(names),
        help="These are the right joints in another order: go through request.names, not through the robot's list "
        "or a sorted one."
        if sorted(names) == sorted(wanted)
        else "Put exactly the names of the request into joint_state.name, one position for each.",
        at=call.answered.t,
    )


def require_positions(call: Call) -> None:
    """Require every joint asked for, each with its position in one of the robot's last messages."""
    names, positions = call.response.joint_state.name, call.response.joint_state.position
    at, published = call.answered.t, call.run.all(ev.JointsPublished)
    expect(
        len(names) == len(positions) > 0,
        expected="as many positions as names, and at least one",
        observed=f"{len(names)} names and {len(positions)} positions",
        help="Fill joint_state.name and joint_state.position together: position[i] belongs to name[i].",
        at=at,
    )
    missing = [name for name in call.request.names if name not in names]
    expect(
        not missing,
        expected=f"a position for each of {listed(call.request.names)}",
        observed=f"none for {listed(missing)}",
        help="Answer for every name of the request.",
        at=at,
    )
    expect(
        any(message.t <= at for message in published),
        expected="positions from the robot's joint_states",
        observed=f"{_described(names, positions)}, although no joint_states had reached your node",
        help=not_heard(call.run),
        at=at,
        see=lesson_on_hearing(call.run, "joint_states"),
    )
    recent = [_positions(message) for message in last_messages(call, ev.JointsPublished, since=_told(call))]
    truth = [recent[-1].get(name, math.nan) for name in names]
    off = [index for index in range(len(names)) if not abs(positions[index] - truth[index]) <= TOLERANCE]
    wrong = [names[index] for index in off]
    expect(
        any(_agree(names, positions, message) for message in recent),
        expected=_described(wrong, [truth[index] for index in off]),
        observed=_described(wrong, [positions[index] for index in off]),
        help=_advice(names, positions, recent[-1], published),
        at=at,
    )


def _told(call: Call) -> float:
    """Return when (s) the scenario last changed the robot before a call, or when the node appeared."""
    events = (*call.run.all(ev.NodeReady), *call.run.all(ev.RobotCommanded))
    return max((event.t for event in events if event.t < call.sent.t), default=0.0)


def _positions(message: ev.JointsPublished) -> Positions:
    return dict(zip(message.names, message.positions, strict=True))


def _agree(names: Sequence[str], positions: Sequence[float], message: Positions) -> bool:
    return all(
        math.isclose(position, message.get(name, math.nan), rel_tol=0.0, abs_tol=TOLERANCE)
        for name, position in zip(names, positions, strict=True)
    )


def _advice(
    names: Sequence[str],
    positions: Sequence[float],
    last: Positions,
    published: Sequence[ev.JointsPublished],
) -> str:
    truth = [last.get(name, math.nan) for name in names]
    if _close(positions, [math.degrees(position) for position in truth], 1.0):
        return "These are degrees. ROS has radians everywhere (REP-103): pass the positions on as they came."
    if _close(positions, truth, 5 * TOLERANCE):
        return "Almost right: pass the positions on as they came, without rounding or averaging."
    if _close(list(map(abs, positions)), list(map(abs, truth)), TOLERANCE):
        return "Only the signs differ: a joint turns both ways, so pass the positions on as they came."
    if any(_agree(names, positions, _positions(message)) for message in published):
        return (
            "This is where the joints were at another time. Replace what you keep each time joint_states arrives, "
            "and make every answer anew."
        )
    if all(any(abs(position - other) < TOLERANCE for other in last.values()) for position in positions):
        return (
            "These positions belong to other joints. position[i] of a joint_states belongs to name[i] of the same "
            "message: look it up by name, as in dict(zip(message.name, message.position))."
        )
    if any(abs(one - other) <= TOLERANCE for one, other in zip(positions, truth, strict=True)):
        return "The other joints are right: pass every position on as it came, without limits or corrections."
    return "Answer with joint_states.position of the last message, looked up by the joint's name."


def _close(some: Sequence[float], others: Sequence[float], tolerance: float) -> bool:
    return all(abs(one - other) <= tolerance for one, other in zip(some, others, strict=True))


def _described(names: Sequence[str], positions: Sequence[float]) -> str:
    return listed([f"{name} {position:.3f}" for name, position in zip(names, positions, strict=True)])
