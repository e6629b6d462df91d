"""Advice on wrong responses of a joint query, and how responses are put into words."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from autograder.authoring import DELIVERY, JOINTS, Call, ev, known_messages, same, why_no_message_arrives
from autograder.authoring.evidence.fields import ROUNDING

from .truth import SILENCE, Positions, is_at, positions_by_name, robot_joints


def listed(words: Sequence[str], most: int = 8) -> str:
    """Join at most `most` words, without control characters; 'no names' if there are none."""
    shown = [word[:60] if word.isprintable() else repr(word[:60]) for word in words[:most]]
    rest = [f"and {len(words) - most} more"] if len(words) > most else []
    return ", ".join(shown + rest) or "no names"


def quoted(words: Sequence[str]) -> str:
    """Join words, with quotes around those that begin or end with a blank."""
    return listed([repr(word) if word.strip() != word or not word else word for word in words])


def asked(call: Call) -> str:
    """Return the requested names in words."""
    return quoted(call.request.names) if call.request.names else "an empty list (all joints)"


def described(names: Sequence[str], positions: Sequence[float]) -> str:
    """Return joints with their positions in words."""
    return listed([f"{name} {position:.6g}" for name, position in zip(names, positions, strict=False)])


def contains_name(message: str, name: str) -> bool:
    """Return whether a message contains a name, not only as part of a longer one."""
    start = r"(?<!\w)" if re.match(r"\w", name) else ""
    end = r"(?!\w)" if re.search(r"\w\Z", name) else ""
    return re.search(start + re.escape(name) + end, message) is not None


def not_heard(call: Call) -> str:
    """Return why the node receives no joint_states, as far as the record shows."""
    cause = why_no_message_arrives(call.run, "joint_states")
    return (
        cause or "Subscribe to joint_states with qos_profile_sensor_data, as the robot publishes best effort."
    )


def on_refusal(call: Call) -> str:
    """Return advice on success false for joints that exist, although joint_states arrived."""
    message, asked = call.response.message, call.run.all(ev.ServiceCalled)
    earlier = [name for other in asked if other.t < call.sent.t for name in other.request.names]
    left = [name for name in earlier if name and name in message and name not in call.request.names]
    if left:
        return f"The message has {left[0]} from an earlier request: start a new list of unknown names in each request."
    silence = call.sent.t - (known_messages(call, JOINTS) or [])[-1].t
    if silence > SILENCE:
        return (
            f"The last message came {silence:.1f} s before the request: use its positions, however old it is."
        )
    if not call.request.names:
        return "An empty list requests every joint of the last joint_states: set success to true."
    if about_repeats(call):
        return "A request may have a name twice: look up each name separately, and do not compare numbers of names."
    answers = call.run.all(ev.ServiceAnswered)
    if any(answer.t < call.sent.t and answer.response.message == message for answer in answers):
        return "joint_states has come since your last success false: in each request check whether there is a message."
    return "Look up each name in the last joint_states, and set success to true if all are found."


def on_names(call: Call, names: list[str], wanted: list[str]) -> str:
    """Return advice on wrong names in a response."""
    others = [other for other in call.run.calls if other.name != call.name]
    if any(names == other.request.names and abs(other.sent.t - call.sent.t) < DELIVERY for other in others):
        return "Requests may be processed at the same time: keep data of one request in local variables, not in self."
    if sorted(names) == sorted(wanted):
        return "These are the right joints in a wrong order: loop over request.names, not the robot's list or a set."
    if set(names) == set(wanted):
        return "Loop over request.names: a set has each name only once." + about_repeats(call)
    return "Put exactly the names of the request into joint_state.name, with one position for each."


def about_repeats(call: Call) -> str:
    """Return advice on repeated names if the request has one, else ''."""
    asked = call.request.names
    return (
        " A name that is twice in the request is twice in the response."
        if len(set(asked)) < len(asked)
        else ""
    )


def on_strangers(call: Call, unknown: Sequence[str]) -> str:
    """Return advice on success true for unknown names."""
    joints = robot_joints(call.run)
    if any(name.strip().lower() in joints for name in unknown):
        return "Compare names exactly, without strip() or lower()."
    if any(name in joint for name in unknown for joint in joints):
        return "Compare whole names: `name in positions` with a dictionary, not `part in name` with a string."
    return "If any name is unknown, set success to false, and write all unknown names into message."


def on_positions(call: Call, names: list[str], positions: list[float], last: Positions) -> str:
    """Return advice on wrong positions (rad), given the last ones."""
    truth = [last.get(name, math.nan) for name in names]
    if _close(positions, [math.degrees(position) for position in truth], 1.0):
        return "These are degrees. ROS uses radians (REP-103): copy the positions unchanged."
    if _close(positions, truth, 0.051):
        return "These positions are almost right: copy them unchanged, without rounding or averaging."
    if _close(list(map(abs, positions)), list(map(abs, truth)), ROUNDING):
        return "Only the signs differ: positions can be negative, so copy them unchanged."
    earlier = [positions_by_name(each) for each in call.run.all(ev.JointsPublished) if each.t < call.sent.t]
    if any(all(map(is_at, names, positions, [table] * len(names))) for table in earlier):
        return (
            "These positions are old: in the callback of joint_states, replace the stored message every time."
        )
    if all(any(same(position, other) for other in last.values()) for position in positions):
        return "These positions belong to other joints: look them up in dict(zip(message.name, message.position))."
    return "Respond with the positions in the last joint_states, looked up by the joint's name."


def _close(some: Sequence[float], others: Sequence[float], tolerance: float) -> bool:
    return all(abs(one - other) <= tolerance for one, other in zip(some, others, strict=True))
