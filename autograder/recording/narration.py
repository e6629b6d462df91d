"""Describes each event in one line of text, for /arena/events, which `course replay` and log viewers show."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from rcl_interfaces.msg import Log

from autograder.authoring.evidence import events as ev
from ros_runtime.message_constants import GoalStatus, name_of
from ros_runtime.messages import is_message, to_dict

INFO, WARN = Log.INFO, Log.WARN
MAX_CHARACTERS = 300  # of a line
_MAX_FIELDS = 12
_MAX_ELEMENTS = 6


def narrated(event: Any) -> tuple[int, str] | None:
    """Return an event's log level and text; None for events that have topics of their own (feedback, output)."""
    described = _of_the_program(event) or _of_interfaces(event) or _of_the_grader(event)
    return (described[0], described[1][:MAX_CHARACTERS]) if described else None


def brief(message: Any) -> str:
    """Return the non-empty fields of a message in one line: plain fields first; for a pose, only the position."""
    if not is_message(message):
        return ""
    fields = sorted(_leaves(to_dict(message)), key=_rank)
    said = ", ".join(f"{name}={value}" for name, value in fields[:_MAX_FIELDS])
    return said + (", …" if len(fields) > _MAX_FIELDS else "")


def _rank(field: tuple[str, str]) -> int:
    name, value = field
    if ".header." in name:
        return 2
    return 1 if "." in name or value.startswith("(") else 0


def _leaves(value: Any, name: str = "") -> Iterator[tuple[str, str]]:
    match value:
        case {"sec": seconds, "nanosec": nanoseconds}:
            if name.rpartition(".")[2] != "stamp" and (seconds or nanoseconds):
                yield name, f"{seconds + nanoseconds * 1e-9:.3g} s"
        case {"position": {"x": x, "y": y, "z": z}, "orientation": _}:
            yield name.removesuffix(".pose"), f"({x:.2f}, {y:.2f}, {z:.2f})"
        case Mapping():
            for key, inner in value.items():
                yield from _leaves(inner, f"{name}.{key}" if name else key)
        case [*elements]:
            if elements:
                shown = [_number(element) for element in elements[:_MAX_ELEMENTS]]
                more = f", … {len(elements)} in all" if len(elements) > _MAX_ELEMENTS else ""
                yield name, f"[{', '.join(shown)}{more}]"
        case _ if value not in (0, "", False):
            yield name, _number(value)


def _number(value: Any) -> str:
    if isinstance(value, Mapping):
        return "…"
    return f"{value:.4g}" if isinstance(value, float) else str(value)[:80]


def _of_the_program(event: Any) -> tuple[int, str] | None:
    match event:
        case ev.NodeStarted():
            return INFO, "the program starts"
        case ev.NodeReady(waited=waited):
            return INFO, f"its services and actions are available after {waited:.1f} s"
        case ev.NodeNotReady(missing=missing, offered=offered):
            return WARN, f"missing: {', '.join(missing)}; available: {', '.join(offered) or 'nothing'}"
        case ev.NodeTyped(line=line):
            return INFO, "stdin ends" if line is None else f"typed: {line}"
        case ev.NodeSignalled(signal=signal):
            return INFO, f"{signal} is sent to the program"
        case ev.NodeExited(returncode=code):
            return INFO, f"the program ended with status {code}"
        case ev.NodeKilled(reason=reason):
            return WARN, f"the program was killed: {reason}"
        case ev.ArenaOverfull(memory_mib=memory, limit_mib=limit):
            return (
                WARN,
                f"the arena was ended: it used {memory:.0f} MiB of memory, and the limit is {limit} MiB",
            )
        case ev.GraphFlooded(reason=reason):
            return WARN, f"the ROS graph was flooded: {reason}"
        case ev.RecordDropped(what=what, count=count):
            return WARN, f"{count} events were not recorded: {what}"
        case ev.TooLarge(what=what, bytes=size, limit=limit):
            return WARN, f"{what} was not read: it has {size} bytes, and the limit is {limit}"
    return None


def _of_interfaces(event: Any) -> tuple[int, str] | None:
    match event:
        case ev.ServiceCalled(call=name, service=service, request=message):
            return INFO, f"call “{name}” of {service}: {brief(message)}".rstrip(": ")
        case ev.RequestReceived(request=name, service=service, message=message):
            return INFO, f"the program calls {service} (“{name}”): {brief(message)}".rstrip(": ")
        case ev.ServiceAnswered(call=name, response=message) | ev.ReplySent(request=name, response=message):
            return INFO, f"response to “{name}”: {brief(message)}".rstrip(": ")
        case ev.GoalSent(goal=goal, action=action, request=message):
            return INFO, f"goal “{goal}” of {action}: {brief(message)}".rstrip(": ")
        case ev.GoalReceived(goal=goal, action=action, message=message):
            return INFO, f"the program sends {action} the goal “{goal}”: {brief(message)}".rstrip(": ")
        case ev.GoalAnswered(goal=goal, accepted=accepted) | ev.GoalReplySent(goal=goal, accepted=accepted):
            return INFO, f"goal “{goal}” {'accepted' if accepted else 'rejected'}"
        case ev.StatusSeen(goal=goal, status=status):
            return INFO, f"status of “{goal}”: {name_of(GoalStatus, status)}"
        case ev.CancelSent(goal=goal) | ev.CancelReceived(goal=goal):
            return INFO, f"cancel “{goal}”" if goal else "cancel every goal"
        case (
            ev.CancelAnswered(canceling=goals, return_code=code)
            | ev.CancelReplySent(canceling=goals, return_code=code)
        ):
            return INFO, f"canceling {', '.join(goals)}" if goals else f"cancel refused (code {code})"
        case ev.GoalFinished(goal=goal, status=status, result=message):
            return INFO, f"goal “{goal}” ends {name_of(GoalStatus, status)}: {brief(message)}".rstrip(": ")
        case ev.ResultReceived(goal=goal, status=status, result=message):
            return INFO, f"result of “{goal}”: {name_of(GoalStatus, status)}, {brief(message)}".rstrip(", ")
        case ev.ResultSent(goal=goal):
            return INFO, f"result of “{goal}” sent"
        case ev.ResultForgotten(goal=goal):
            return INFO, f"the grader's server drops the result of “{goal}”"
        case ev.Unanswered(what=what, id=name, waited=waited):
            within = f" within {waited:.1f} s" if waited >= 0.05 else ""  # after the program's end
            return WARN, f"no response to the {what} “{name}”{within}"
    return None


def _of_the_grader(event: Any) -> tuple[int, str] | None:
    match event:
        case ev.RobotCommanded(command=command, verb=verb):
            arguments = ", ".join(f"{key}={value}" for key, value in command.items() if key != "do")
            return INFO, f"the grader: {verb} {arguments}".rstrip()
        case ev.RobotRefused(topic=topic, count=count, reason=reason):
            return WARN, f"the robot refused {count} messages on {topic}: {reason}"
        case ev.ServiceOffered(service=name) | ev.ActionOffered(action=name):
            return INFO, f"the grader offers {name}"
        case ev.ServiceWithdrawn(service=name) | ev.ActionWithdrawn(action=name):
            return INFO, f"the server of {name} dies"
        case ev.Mark(name=name):
            return INFO, f"— {name} —"
        case ev.ScenarioEnded():
            return INFO, "the scenario ends"
    return None
