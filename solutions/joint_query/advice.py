"""What to do about a wrong answer of a joint query, by what it looks like, and how answers are shown."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from autograder.authoring import DELIVERY, JOINTS, Call, ev, known_messages, same, why_no_message_arrives
from autograder.authoring.evidence.fields import ROUNDING

from .truth import SILENCE, Positions, is_at, positions_by_name, robot_joints


def listed(words: Sequence[str], most: int = 8) -> str:
    """Join at most `most` words, without control characters; say so if there are none."""
    shown = [word[:60] if word.isprintable() else repr(word[:60]) for word in words[:most]]
    rest = [f"and {len(words) - most} more"] if len(words) > most else []
    return ", ".join(shown + rest) or "no names"


def quoted(words: Sequence[str]) -> str:
    """Join words, those with blanks at an end in quotes."""
    return listed([repr(word) if word.strip() != word or not word else word for word in words])


def asked(call: Call) -> str:
    """Return the names asked for."""
    return quoted(call.request.names) if call.request.names else "an empty list (all joints)"


def described(names: Sequence[str], positions: Sequence[float]) -> str:
    """Return joints with their positions."""
    return listed([f"{name} {position:.6g}" for name, position in zip(names, positions, strict=False)])


def contains_name(message: str, name: str) -> bool:
    """Return whether a message contains a name, and not only as a part of a longer one."""
    start = r"(?<!\w)" if re.match(r"\w", name) else ""
    end = r"(?!\w)" if re.search(r"\w\Z", name) else ""
    return re.search(start + re.escape(name) + end, message) is not None


def not_heard(call: Call) -> str:
    """Return why no joint_states reach the node, as far as the grader saw."""
    deaf = why_no_message_arrives(call.run, "joint_states")
    return deaf or "Subscribe to joint_states with qos_profile_sensor_data: the robot publishes best effort."


def on_refusal(call: Call) -> str:
    """Say what is wrong about a refusal of joints that exist, though joint_states arrives."""
    message, asked = call.response.message, call.run.all(ev.ServiceCalled)
    earlier = [name for other in asked if other.t < call.sent.t for name in other.request.names]
    left = [name for name in earlier if name and name in message and name not in call.request.names]
    if left:
        return f"The message names {left[0]}, of an earlier request: begin a new list of unknown names in each request."
    silence = call.sent.t - (known_messages(call, JOINTS) or [])[-1].t
    if silence > SILENCE:
        return f"The last message came {silence:.1f} s ago, and that is no reason to forget it."
    if not call.request.names:
        return "An empty list asks for every joint of the last joint_states: that is a success."
    if about_repeats(call):
        return "A name may be asked for twice: look each up by itself, and do not compare numbers of names."
    answers = call.run.all(ev.ServiceAnswered)
    if any(answer.t < call.sent.t and answer.response.message == message for answer in answers):
        return "joint_states has arrived since your last refusal: look at each request whether there is a message."
    return "Look up each name in the name list of the last joint_states, and set success when all are there."


def on_names(call: Call, names: list[str], wanted: list[str]) -> str:
    """Say what is wrong about the names of an answer."""
    others = [other for other in call.run.calls if other.name != call.name]
    if any(names == other.request.names and abs(other.sent.t - call.sent.t) < DELIVERY for other in others):
        return "Requests may be served at the same time: keep what belongs to one in local variables, not in self."
    if sorted(names) == sorted(wanted):
        return "These are the right joints in another order: go through request.names, not the robot's list or a set."
    if set(names) == set(wanted):
        return "Go through request.names one by one: a set holds each name once." + about_repeats(call)
    return "Put exactly the names of the request into joint_state.name, one position for each."


def about_repeats(call: Call) -> str:
    """Say that a name may come twice, if one did."""
    asked = call.request.names
    return " A name that was asked for twice is answered twice." if len(set(asked)) < len(asked) else ""


def on_strangers(call: Call, unknown: Sequence[str]) -> str:
    """Say what is wrong about a success with unknown names."""
    joints = robot_joints(call.run)
    if any(name.strip().lower() in joints for name in unknown):
        return "Compare names letter by letter: no strip(), no lower()."
    if any(name in joint for name in unknown for joint in joints):
        return "Compare whole names: `name in positions` with a dictionary, not `part in name` with a string."
    return "An unknown name fails the whole request: success stays false and message says which names."


def on_positions(call: Call, names: list[str], positions: list[float], last: Positions) -> str:
    """Say what is wrong about positions (rad), given the last ones."""
    truth = [last.get(name, math.nan) for name in names]
    if _close(positions, [math.degrees(position) for position in truth], 1.0):
        return "These are degrees. ROS has radians everywhere (REP-103): pass the positions on as they came."
    if _close(positions, truth, 0.051):
        return "Almost right: pass the positions on as they came, without rounding or averaging."
    if _close(list(map(abs, positions)), list(map(abs, truth)), ROUNDING):
        return "Only the signs differ: a joint turns both ways, so pass the positions on as they came."
    earlier = [positions_by_name(each) for each in call.run.all(ev.JointsPublished) if each.t < call.sent.t]
    if any(all(map(is_at, names, positions, [table] * len(names))) for table in earlier):
        return "This is where the joints were at another time: replace what you keep each time joint_states arrives."
    if all(any(same(position, other) for other in last.values()) for position in positions):
        return "These positions belong to other joints: look them up in dict(zip(message.name, message.position))."
    return "Answer with joint_states.position of the last message, looked up by the joint's name."


def _close(some: Sequence[float], others: Sequence[float], tolerance: float) -> bool:
    return all(abs(one - other) <= tolerance for one, other in zip(some, others, strict=True))
