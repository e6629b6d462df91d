"""Chapter 10: parameters and balance."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import yaml
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64

from lab.client.connection import connection
from lab.client.waiting import comes_true
from lab.errors import NodeEndedError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import (
    call_student_service,
    last_error_or_line,
    read_program,
    run_student_code,
)
from lab.running.student_nodes import StudentNode, run_node

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
TRIAL_NAMESPACE = "/trial"  # a namespace in which no robot hears cmd_vel
NODE_NAME = "/robot/circle"
FILE_VALUES = {"speed": 0.2, "turn": 0.25}  # of start.yaml
MESSAGE_TIMEOUT = 3.0  # s for a message
HINTS = {
    "ZeroDivisionError": "a robot that walks straight turns by 0.0: multiply, do not divide by the turn",
    "": "fix the error that is named here: an exception in a callback ends the node",
}


def decides_about_what_is_asked_for() -> str:
    """Ask about one set after the other, each with the values as they are."""
    decide = read_program("decide.py")["decide"]
    straight, wide, half = (
        {"speed": 0.2, "turn": 0.0},
        {"speed": 0.1, "turn": 0.2},
        {"speed": 0.2, "turn": 0.4},
    )
    cases: tuple[tuple[Mapping[str, float], Mapping[str, Any], bool, str], ...] = (
        (straight, {"speed": 0.3}, True, "a good set: go on to the last line"),
        (
            straight,
            {"speed": 0.0},
            True,
            "a robot that stands walks no circle: multiply, do not divide by the turn",
        ),
        (
            wide,
            {"turn": 0.45},
            False,
            "judge the new value, which is in `parameters`; `now` has the old ones",
        ),
        (half, {"speed": 0.1}, False, "the turn stays 0.4: take what is not in the list from `wanted`"),
        (wide, {"turn": -0.45}, False, "a turn to the right is negative: compare with abs(turn)"),
        (half, {"turn": -0.4}, True, "the same circle to the right: compare with abs(turn)"),
        (wide, {"turn": 0.45, "speed": 0.2}, True, "lay all new values over the old ones before you judge"),
        (wide, {"speed": 0.3, "turn": 0.9}, True, "lay all new values over the old ones before you judge"),
        (half, {"turn": 0.1, "speed": 0.01}, False, "judge after the loop, with all the new values"),
        (half, {"speed": math.nan}, False, "every `<` and `>` with NaN is false: ask `not speed >= …`"),
        (half, {"turn": math.nan}, False, "every `<` and `>` with NaN is false: ask `not speed >= …`"),
        (
            {**half, "use_sim_time": False},
            {"use_sim_time": True},
            True,
            "every node has parameters that are not yours: let them through",
        ),
    )
    for now, new, wanted, advice in cases:
        given = dict(now)
        parameters = [Parameter(name, value=value) for name, value in new.items()]
        result = run_student_code(partial(decide, given, parameters), "decide.py", hints=HINTS)
        about = f"{_words(new)} on top of {_words(now)}"
        expect(
            isinstance(result, SetParametersResult),
            seen=f"{result!r} for {about}",
            expected="a SetParametersResult",
            next="return SetParametersResult(successful=False, reason=…) where you refuse",
        )
        expect(
            given == now,
            seen=f"`now` was changed to {_words(given)}",
            expected="`now` as it was: deciding has no side effect",
            next="write into `wanted`",
        )
        expect(
            result.successful == wanted,
            seen=f"{'accepted' if result.successful else 'refused'}: {about}",
            expected="accepted" if wanted else "refused",
            next=advice,
        )
        expect(
            result.successful or result.reason.strip(),
            seen=f"{about} is refused without a reason",
            expected="a reason for people",
            next="give SetParametersResult a reason=…, too",
        )
    refused = sum(not wanted for _, _, wanted, _ in cases)
    return f"{len(cases) - refused} sets accepted, {refused} refused with a reason, two of them NaN"


def sees_every_set() -> str:
    """Start guarded.py with good values, set some, and start it again with bad ones."""
    with _radii() as radii:
        node = _start_or_explain(speed=0.1, turn=0.2)
        expect(
            comes_true(lambda: radii, MESSAGE_TIMEOUT),
            seen="no message on radius after the start",
            expected="0.5, for a speed of 0.1 and a turn of 0.2",
            next="call self.apply([]) once, as the last of the four",
        )
        refused = _set(node, speed=0.05)
        accepted = _set(node, turn=0.25)
        expect(
            not refused.successful,
            seen="a speed of 0.05 with a turn of 0.2 was accepted, a circle of 0.25 m",
            expected="refused",
            next="register self.decide with self.add_on_set_parameters_callback()",
        )
        expect(
            accepted.successful,
            seen=f"turn 0.25 was refused: {accepted.reason}",
            expected="accepted",
            next="register self.decide with add_on_set_parameters_callback, self.apply with add_post_set_…",
        )
        expect(
            comes_true(lambda: math.isclose(radii[-1], 0.1 / 0.25), MESSAGE_TIMEOUT),
            seen="no new message on radius after an accepted set",
            expected="0.4, for a speed of 0.1 and a turn of 0.25",
            next="register self.apply with self.add_post_set_parameters_callback()",
        )
        number = len(radii)
    node.stop()
    try:
        node = _start(speed=0.1, turn=0.45)
    except NodeEndedError:
        return f"{number} messages on radius for the start and one set, and a bad start ended the node"
    raise not_yet(
        "started with -p speed:=0.1 -p turn:=0.45, the node runs: nobody asked self.decide",
        "a node that ends with InvalidParameterValueException",
        "register self.decide before self.declare(): each declaration is a set",
    )


def starts_from_the_file() -> str:
    """Start guarded.py with start.yaml, and ask what it has."""
    text = Path("start.yaml").read_text(encoding="utf-8")
    try:
        node = run_node("guarded.py", "--ros-args", "--params-file", "start.yaml")
    except NodeEndedError as problem:
        reason = str(problem).strip().splitlines()[-1]
        raise not_yet(
            f"the node ended at once: {reason}", "a node that starts", _about_the_file(text)
        ) from None
    values = call_student_service(
        node, "circle/get_parameters", GetParameters, GetParameters.Request(names=list(FILE_VALUES))
    ).values
    found = {name: value.double_value for name, value in zip(FILE_VALUES, values, strict=True)}
    expect(
        found == FILE_VALUES,
        seen=f"the node has {_words(found)}",
        expected=_words(FILE_VALUES),
        next=_about_the_file(text),
    )
    return f"started with {_words(found)}: a circle of {found['speed'] / found['turn']:.1f} m"


def _about_the_file(text: str) -> str:
    """Say what is wrong with a file of parameters, as a student should mend it."""
    levels = "three levels, each two spaces further in: the node, ros__parameters, and name: value"
    try:
        content = yaml.safe_load(text)
    except yaml.YAMLError:
        return f"this is no YAML: write {levels}; a space follows each colon"
    if not isinstance(content, dict):
        return f"write {levels}; a space follows each colon"
    if NODE_NAME not in content and "/**" not in content:
        return f"the first line is the node's full name, {NODE_NAME}:"
    section = content[NODE_NAME] if NODE_NAME in content else content["/**"]
    if not isinstance(section, dict) or "ros__parameters" not in section:
        return f"below the node stands ros__parameters: with two underscores; write {levels}"
    if not isinstance(section["ros__parameters"], dict):
        return f"a space follows each colon; write {levels}"
    parameters = section["ros__parameters"]
    for name, value in FILE_VALUES.items():
        if name not in parameters:
            return f"there is no {name} below ros__parameters; a name that nobody declares is ignored"
        if not isinstance(parameters[name], float):
            return f"{name} has to be a double, such as {value}"
    return f"write speed: {FILE_VALUES['speed']} and turn: {FILE_VALUES['turn']}"


def _start_or_explain(**values: float) -> StudentNode:
    """Start guarded.py with good values."""
    try:
        return _start(**values)
    except NodeEndedError as problem:
        reason = last_error_or_line(str(problem), "guarded.py")
        if "NotDeclared" in reason:
            advice = (
                "self.apply needs both parameters: call self.declare(), then register self.apply with "
                "add_post_set_parameters_callback, then call it"
            )
        elif "invalid type" in reason:
            advice = (
                "self.decide says yes or no: it belongs to add_on_set_…; self.apply belongs to add_post_set_…"
            )
        else:
            advice = "fix the error that is named here"
        raise not_yet(f"the node ended at once: {reason}", "a node that runs", advice) from None


def _start(**values: float) -> StudentNode:
    given = [word for name, value in values.items() for word in ("-p", f"{name}:={value}")]
    return run_node("guarded.py", "--ros-args", "-r", f"__ns:={TRIAL_NAMESPACE}", *given)


def _set(node: StudentNode, **values: float) -> SetParametersResult:
    request = SetParameters.Request(
        parameters=[Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
    )
    return call_student_service(
        node, f"{TRIAL_NAMESPACE}/circle/set_parameters", SetParameters, request
    ).results[0]


@contextmanager
def _radii() -> Iterator[list[float]]:
    """Give the list of what arrives on the node's topic radius."""
    radii: list[float] = []

    def keep(message: Float64) -> None:
        radii.append(message.data)

    subscription = connection().node.create_subscription(Float64, f"{TRIAL_NAMESPACE}/radius", keep, LATCHED)
    try:
        yield radii
    finally:
        connection().node.destroy_subscription(subscription)


def _words(values: Mapping[str, Any]) -> str:
    return ", ".join(f"{name} {value}" for name, value in values.items())


def waits_until_it_lasts() -> str:
    """Show two conditions at different times, one of them from time 0 on."""
    make = read_program("steady.py")["Steady"]
    one, other = (run_student_code(partial(make, seconds), "steady.py") for seconds in (0.5, 0.2))
    moments: tuple[tuple[Any, float, bool, bool, str], ...] = (
        (one, 0.0, True, False, "it has only just begun"),
        (one, 0.3, True, False, "it is so for 0.3 s, not for 0.5 s"),
        (other, 0.35, False, False, "this is another condition, which is false"),
        (one, 0.55, True, True, "it is so for 0.55 s, since 0.0: 0.0 is a time, so ask `self.since is None`"),
        (one, 0.9, True, True, "it still is: keep the first moment"),
        (one, 1.0, False, False, "it is no longer so"),
        (one, 1.1, True, False, "it has just begun again: a break sets self.since back to None"),
        (one, 1.4, False, False, "it is not so"),
        (other, 1.45, False, False, "this is another condition, which is still false"),
        (one, 1.5, True, False, "0.4 s ago it was so, but not without a break"),
        (other, 1.5, True, False, "each object has a moment of its own: keep it in self"),
        (one, 1.8, True, False, "since 1.5 it is so, for 0.3 s"),
        (
            other,
            1.75,
            True,
            True,
            "it is so for 0.25 s, and this one asks for 0.2 s: compare with self.seconds",
        ),
        (one, 2.05, True, True, "it is so for 0.55 s without a break"),
    )
    for steady, now, is_so, wanted, reason in moments:
        got = run_student_code(partial(steady.lasts, is_so, now), "steady.py")
        expect(
            got == wanted,
            seen=f"{got!r} at {now} s from Steady({0.5 if steady is one else 0.2}), with is_so {is_so}",
            expected=repr(wanted),
            next="end each path with `return` and True or False" if got is None else reason,
        )
    return "it told what lasts from what only comes by"


GAPS = (
    Gap("decide.py", decides_about_what_is_asked_for),
    Gap("guarded.py", sees_every_set),
    Gap("start.yaml", starts_from_the_file),
    Gap("steady.py", waits_until_it_lasts),
)
