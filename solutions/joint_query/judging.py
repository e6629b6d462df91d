"""How an answer of the joint query is compared with what was asked and with what the robot published."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from autograder.authoring import events as ev
from autograder.authoring.checks import Failure, expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.server_checks import last_messages, require_answer
from autograder.authoring.transcript import CallHistory, Transcript

SERVICE = "get_joint_positions"
MOVED = 0.1  # rad that a joint may be off where it was told to be, under its load
TOLERANCE = 0.01  # rad; the robot itself gives by half as much while it settles in its stance

_NOT_HEARD = (
    "Subscribe to joint_states: compare the name (relative) and the type letter by letter, and give "
    "qos_profile_sensor_data. The robot publishes best effort, which a reliable subscription never gets."
)

Positions = Mapping[str, float]  # rad, by the joint's name


def call_for(run: Transcript, names: Sequence[str]) -> CallHistory:
    """Return the call that asked for these names; it and those before it must have been answered."""
    for call in run.calls:
        require_answer(run, call)
        if asked(call) == list(names):
            return call
    raise Missing(
        run,
        expected=f"a server that gets as far as the question for {listed(names)}",
        never="that was never asked",
    )


def question(run: Transcript, number: int) -> CallHistory:
    """Return the first (`number` 1), second, … call of all; it and those before it must have been answered."""
    for earlier in range(1, number):
        require_answer(run, run.call(SERVICE, earlier))
    call = run.call(SERVICE, number)
    require_answer(run, call)
    return call


def require_silence_so_far(run: Transcript, call: CallHistory) -> None:
    """The robot had published no joints yet when the call was answered."""
    answer = require_answer(run, call)
    spoke = [
        event for event in (*run.all(ev.JointsPublished), *run.all(ev.RobotCommanded)) if event.t <= answer.t
    ]
    if spoke:
        raise unseen(run, "the joint sensors were plugged in too early")


def require_posture(run: Transcript, call: CallHistory, posture: Positions) -> None:
    """The scenario moved the joints, and published them where they are now, in time for the call."""
    told = run.told("move_joints", before=call.sent.t, positions=dict(posture))
    messages = last_messages(run, ev.JointsPublished, call, since=told.t)
    reached = _positions(messages[0])
    away = {name: reached.get(name, math.inf) - angle for name, angle in posture.items()}
    name = max(away, key=lambda joint: abs(away[joint]))
    expect(
        abs(away[name]) <= MOVED,
        expected=f"the robot's {name} at {posture[name]:.2f} rad, where it was told to be",
        observed=f"it is {abs(away[name]):.2f} rad off",
        help="Publish nothing: whoever answers questions about the joints must not move them.",
        at=messages[0].t,
    )


def require_reversed(run: Transcript, call: CallHistory) -> None:
    """The robot listed its joints in the other order, in time for the call."""
    told = run.told("joint_states", before=call.sent.t, reversed=True)
    messages = last_messages(run, ev.JointsPublished, call, since=told.t)
    before = [message for message in run.all(ev.JointsPublished) if message.t <= told.t]
    if not before or messages[0].names == before[0].names:
        raise unseen(run, "the robot never listed its joints in another order")


def asked(call: CallHistory) -> list[str]:
    """Return the names of the request."""
    return call.sent.request["names"]


def listed(words: Sequence[str], most: int = 8) -> str:
    """Join words, or say that there are none; of many only the first `most`, and nothing that moves a cursor."""
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
            help=_NOT_HEARD,
        )
    return published.names


def require_success(run: Transcript, call: CallHistory) -> None:
    """It answered success, since every joint asked for exists."""
    answer = require_answer(run, call)
    heard = run.first(ev.JointsPublished) is not None
    expect(
        answer.response["success"] is True,
        expected=f"success: true for {listed(asked(call))}, which the robot has",
        observed=_outcome(answer),
        help="Look up each name in the name list of the last joint_states, and set success when all are there."
        if heard
        else _NOT_HEARD,
        at=answer.t,
    )


def require_refusal(run: Transcript, call: CallHistory, *, because: str, help: str) -> None:
    """It answered success: false."""
    answer = require_answer(run, call)
    expect(
        answer.response["success"] is False,
        expected=f"success: false for {listed(asked(call))}, because {because}",
        observed=_outcome(answer),
        help=help,
        at=answer.t,
    )


def require_names(run: Transcript, call: CallHistory) -> None:
    """The answer lists the joints asked for, in the order of the request."""
    answer = require_answer(run, call)
    names = answer.response["joint_state"]["name"]
    if names == asked(call):
        return
    raise Failure(
        expected=f"joint_state.name as asked: {listed(asked(call))}",
        observed=listed(names),
        help="These are the right joints in another order: go through request.names, not through the robot's list "
        "or a sorted one."
        if sorted(names) == sorted(asked(call))
        else "Put exactly the names of the request into joint_state.name, one position for each.",
        at=answer.t,
    )


def require_positions(run: Transcript, call: CallHistory) -> None:
    """Every joint asked for is there, each with the position it has in one of the last messages of the robot."""
    answer = require_answer(run, call)
    names, positions = (answer.response["joint_state"][field] for field in ("name", "position"))
    expect(
        len(names) == len(positions) > 0,
        expected="as many positions as names, and at least one",
        observed=f"{len(names)} names and {len(positions)} positions",
        help="Fill joint_state.name and joint_state.position together: position[i] belongs to name[i].",
        at=answer.t,
    )
    missing = [name for name in asked(call) if name not in names]
    expect(
        not missing,
        expected=f"a position for each of {listed(asked(call))}",
        observed=f"none for {listed(missing)}",
        help="Answer for every name of the request.",
        at=answer.t,
    )
    expect(
        any(message.t <= answer.t for message in run.all(ev.JointsPublished)),
        expected="positions from the robot's joint_states",
        observed=f"{_described(names, positions)}, although no joint_states had reached your node",
        help=_NOT_HEARD,
        at=answer.t,
    )
    recent = [
        _positions(message)
        for message in last_messages(run, ev.JointsPublished, call, since=_told(run, call))
    ]
    if any(_agree(names, positions, message) for message in recent):
        return
    truth = [recent[-1].get(name, math.nan) for name in names]
    raise Failure(
        expected=_described(names, truth),
        observed=_described(names, positions),
        help=_advice(names, positions, recent[-1], run.all(ev.JointsPublished)),
        at=answer.t,
    )


def _told(run: Transcript, call: CallHistory) -> float:
    """When (s) the scenario last did something to the robot before a call; at the latest when the node was there."""
    moments = [
        event.t for event in (*run.all(ev.NodeReady), *run.all(ev.RobotCommanded)) if event.t < call.sent.t
    ]
    return max(moments, default=0.0)


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
    return "Answer with joint_states.position of the last message, looked up by the joint's name."


def _close(some: Sequence[float], others: Sequence[float], tolerance: float) -> bool:
    return all(abs(one - other) <= tolerance for one, other in zip(some, others, strict=True))


def _described(names: Sequence[str], positions: Sequence[float]) -> str:
    return listed([f"{name} {position:.3f}" for name, position in zip(names, positions, strict=True)])


def _outcome(answer: ev.ServiceAnswered) -> str:
    success = str(answer.response["success"]).lower()
    return f"success: {success}, message: {answer.response['message'][:200]!r}"
