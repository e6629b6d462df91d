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
from lab.client.waiting import becomes_true
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
TRIAL_NAMESPACE = "/trial"  # no robot in it subscribes to cmd_vel
NODE_NAME = "/robot/circle"
FILE_VALUES = {"speed": 0.2, "turn": 0.25}  # of start.yaml
MESSAGE_TIMEOUT = 3.0  # s
HINTS = {
    "ZeroDivisionError": "multiply instead of dividing by the turn: it is 0.0 for a robot that walks straight",
    "": "fix the error that is named here: an exception in a callback ends the node",  # any other exception
}


def decides_by_the_new_values() -> str:
    """Call decide() with several sets of parameters and current values."""
    decide = read_program("decide.py")["decide"]
    straight, wide, half = (
        {"speed": 0.2, "turn": 0.0},
        {"speed": 0.1, "turn": 0.2},
        {"speed": 0.2, "turn": 0.4},
    )
    cases: tuple[tuple[Mapping[str, float], Mapping[str, Any], bool, str], ...] = (
        (straight, {"speed": 0.3}, True, "this set is allowed: return only for a circle that is too tight"),
        (
            straight,
            {"speed": 0.0},
            True,
            "0.0 m/s with a turn of 0.0 is no tight circle: require at least TIGHTEST * abs(turn), with >=",
        ),
        (
            wide,
            {"turn": 0.45},
            False,
            "check the new value, which is in `parameters`; `now` has the old values",
        ),
        (
            half,
            {"speed": 0.1},
            False,
            "the turn stays 0.4: take a value that is not in `parameters` from `wanted`",
        ),
        (wide, {"turn": -0.45}, False, "a turn to the right is negative: compare with abs(turn)"),
        (half, {"turn": -0.4}, True, "the circle to the right has the same radius: compare with abs(turn)"),
        (
            wide,
            {"turn": 0.45, "speed": 0.2},
            True,
            "write all new values into `wanted` before you check the radius",
        ),
        (
            wide,
            {"speed": 0.3, "turn": 0.9},
            True,
            "write all new values into `wanted` before you check the radius",
        ),
        (half, {"turn": 0.1, "speed": 0.01}, False, "check the radius after the loop, with all new values"),
        (half, {"speed": math.nan}, False, "every `<` and `>` with NaN is false: test `not speed >= …`"),
        (half, {"turn": math.nan}, False, "every `<` and `>` with NaN is false: test `not speed >= …`"),
        (
            {**half, "use_sim_time": False},
            {"use_sim_time": True},
            True,
            "every node has parameters that you did not declare: accept them",
        ),
    )
    for now, new, wanted, advice in cases:
        given = dict(now)
        parameters = [Parameter(name, value=value) for name, value in new.items()]
        result = run_student_code(partial(decide, given, parameters), "decide.py", hints=HINTS)
        about = f"the set {_words(new)} while the node has {_words(now)}"
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
            seen=f"decide() {'accepts' if result.successful else 'refuses'} {about}",
            expected="the set is accepted" if wanted else "the set is refused",
            next=advice,
        )
        expect(
            result.successful or result.reason.strip(),
            seen=f"without a reason, decide() refuses {about}",
            expected="a reason for people",
            next="pass a reason=… to SetParametersResult, too",
        )
    refused = sum(not wanted for _, _, wanted, _ in cases)
    return f"{len(cases) - refused} sets accepted, {refused} refused with a reason, two of them NaN"


def publishes_for_every_accepted_set() -> str:
    """Start guarded.py with valid values, set parameters, and start it again with invalid values."""
    with _radii() as radii:
        node = _start_or_explain(speed=0.1, turn=0.2)
        expect(
            becomes_true(lambda: radii, MESSAGE_TIMEOUT),
            seen="no message arrived on radius after the start",
            expected="0.5 on radius, for a speed of 0.1 and a turn of 0.2",
            next="call self.apply([]) once, as the last of the four calls",
        )
        refused = _set(node, speed=0.05)
        accepted = _set(node, turn=0.25)
        expect(
            not refused.successful,
            seen="the node accepted a speed of 0.05 with a turn of 0.2, a circle of only 0.25 m",
            expected="the set is refused",
            next="register self.decide with self.add_on_set_parameters_callback()",
        )
        expect(
            accepted.successful,
            seen=f"the node refused a turn of 0.25: {accepted.reason}",
            expected="the set is accepted",
            next="register self.decide with add_on_set_parameters_callback, and self.apply with "
            "add_post_set_parameters_callback",
        )
        expect(
            becomes_true(lambda: math.isclose(radii[-1], 0.1 / 0.25), MESSAGE_TIMEOUT),
            seen="no new message arrived on radius after an accepted set",
            expected="0.4 on radius, for a speed of 0.1 and a turn of 0.25",
            next="register self.apply with self.add_post_set_parameters_callback()",
        )
        number = len(radii)
    node.stop()
    try:
        node = _start(speed=0.1, turn=0.45)
    except NodeEndedError:
        return f"{number} messages on radius for the start and one set; invalid values at the start ended the node"
    raise not_yet(
        "started with -p speed:=0.1 -p turn:=0.45, the node runs: self.decide was not called for these values",
        "the node ends with InvalidParameterValueException",
        "register self.decide before self.declare(): each declaration is a set, too",
    )


def starts_from_the_file() -> str:
    """Start guarded.py with start.yaml, and read its parameters."""
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
        seen=f"the node's parameters are {_words(found)}",
        expected=_words(FILE_VALUES),
        next=_about_the_file(text),
    )
    return f"started with {_words(found)}: a circle of {found['speed'] / found['turn']:.1f} m"


def _about_the_file(text: str) -> str:
    """Return the advice on how to correct a parameter file."""
    levels = "three levels, each indented by two more spaces: the node, ros__parameters, and name: value"
    try:
        content = yaml.safe_load(text)
    except yaml.YAMLError:
        return f"the file is not valid YAML: write {levels}, with a space after each colon"
    if not isinstance(content, dict):
        return f"write {levels}, with a space after each colon"
    if NODE_NAME not in content and "/**" not in content:
        return f"begin the file with the node's full name, {NODE_NAME}:"
    section = content[NODE_NAME] if NODE_NAME in content else content["/**"]
    if not isinstance(section, dict) or "ros__parameters" not in section:
        return f"write ros__parameters: with two underscores below the node's name; write {levels}"
    if not isinstance(section["ros__parameters"], dict):
        return f"write a space after each colon; write {levels}"
    parameters = section["ros__parameters"]
    for name, value in FILE_VALUES.items():
        if name not in parameters:
            return f"add {name} below ros__parameters; a parameter that the node does not declare is ignored"
        if not isinstance(parameters[name], float):
            return f"make {name} a double, such as {value}"
    return f"write speed: {FILE_VALUES['speed']} and turn: {FILE_VALUES['turn']}"


def _start_or_explain(**values: float) -> StudentNode:
    """Start guarded.py with valid values.

    Raises GapError when the node ends at once; the message says what to do.
    """
    try:
        return _start(**values)
    except NodeEndedError as problem:
        reason = last_error_or_line(str(problem), "guarded.py")
        if "NotDeclared" in reason:
            advice = (
                "self.apply needs both parameters: call self.declare(), then register self.apply with "
                "add_post_set_parameters_callback, then call self.apply([])"
            )
        elif "invalid type" in reason:
            advice = (
                "register self.decide, which accepts or refuses, with add_on_set_parameters_callback, and self.apply "
                "with add_post_set_parameters_callback"
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
    """Subscribe to the node's topic radius while the block runs; yield the list of received values."""
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


def waits_for_a_lasting_condition() -> str:
    """Call lasts() of three objects at several times, for one of them from time 0 on."""
    make = read_program("steady.py")["Steady"]
    one, other, instant = (
        run_student_code(partial(make, seconds), "steady.py") for seconds in (0.5, 0.2, 0.0)
    )
    moments: tuple[tuple[Any, float, bool, bool, str], ...] = (
        (one, 0.0, True, False, "the condition has only just become true: return False"),
        (one, 0.3, True, False, "the condition has been true for 0.3 s, less than 0.5 s: return False"),
        (other, 0.35, False, False, "the condition of this second object is false: return False"),
        (
            one,
            0.55,
            True,
            True,
            "the condition has been true for 0.55 s, since 0.0; 0.0 is a valid time, so test `self.since is None`",
        ),
        (
            one,
            0.9,
            True,
            True,
            "the condition is still true: do not overwrite self.since while it stays true",
        ),
        (one, 1.0, False, False, "the condition is false now: return False"),
        (
            one,
            1.1,
            True,
            False,
            "the condition has just become true again: set self.since to None when it is false",
        ),
        (one, 1.4, False, False, "the condition is false: return False"),
        (other, 1.45, False, False, "the condition of this second object is still false: return False"),
        (
            one,
            1.5,
            True,
            False,
            "the condition was false in between: set self.since to None when it is false",
        ),
        (other, 1.5, True, False, "each object needs its own start time: store it in self.since"),
        (one, 1.8, True, False, "the condition has been true for 0.3 s, since 1.5: return False"),
        (
            other,
            1.75,
            True,
            True,
            "the condition has been true for 0.25 s, and this object needs 0.2 s: compare with self.seconds",
        ),
        (one, 2.05, True, True, "the condition has been true for 0.55 s without a break: return True"),
        (
            instant,
            2.1,
            True,
            True,
            "the condition has been true for 0.0 s, and Steady(0.0) needs no more: return now - self.since >= "
            "self.seconds in the first round, too",
        ),
        (instant, 2.15, False, False, "the condition is false: return False"),
    )
    seconds = {id(one): 0.5, id(other): 0.2, id(instant): 0.0}
    for steady, now, is_so, wanted, reason in moments:
        got = run_student_code(partial(steady.lasts, is_so, now), "steady.py")
        is_renewed = wanted and steady is not instant and getattr(steady, "since", None) == now
        expect(
            got == wanted,
            seen=f"lasts({is_so}, {now}) of Steady({seconds[id(steady)]}) returned {got!r}",
            expected=repr(wanted),
            next="end each path with `return` and True or False"
            if got is None
            else "remember `now` only when the condition has become true: do not overwrite self.since while it stays "
            "true"
            if is_renewed
            else reason,
        )
    return f"the right value in {len(moments)} calls: a condition that was false in between starts anew"


GAPS = (
    Gap("decide.py", decides_by_the_new_values),
    Gap("guarded.py", publishes_for_every_accepted_set),
    Gap("start.yaml", starts_from_the_file),
    Gap("steady.py", waits_for_a_lasting_condition),
)
