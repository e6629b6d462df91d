"""Chapter 4: your own interfaces."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Sequence
from pathlib import Path

from geometry_msgs.msg import PointStamped

from lab.errors import LabError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import call_student_service
from lab.running.student_nodes import run_node
from ros_runtime.interface_build.definitions import SEPARATOR, InvalidDefinitions, Part
from ros_runtime.interface_build.student_package import checked_definitions

PACKAGE = "my_interfaces"
ACTION = "WalkAhead"
DEFINITION = f"{PACKAGE}/action/{ACTION}.action"
FIELDS = {"error_code": "uint16", "error_msg": "string", "distance_walked": "float64"}
CONSTANTS = {"NONE": ("uint16", 0), "FELL": ("uint16", 1)}
METRE = re.compile(r"#.*\b(m|met(re|er)s?)\b", re.IGNORECASE)


def has_a_result() -> str:
    """Parse the definition as the build does, and check the comment that has the unit."""
    result = _result()
    for name, constant in CONSTANTS.items():
        expect(
            result.constants.get(name) == constant,
            seen=_as_written(result),
            expected=f"a constant {constant[0]} {name}={constant[1]}",
            next=f"write the line `{constant[0]} {name}={constant[1]}`: the = makes {name} a constant",
        )
    for name, kind in FIELDS.items():
        expect(
            result.fields.get(name) == kind,
            seen=_as_written(result),
            expected=f"a field {name} of type {kind}",
            next=f"write the line `{kind} {name}`",
        )
    others = sorted(result.fields.keys() - FIELDS.keys())
    expect(
        not others,
        seen=f"the result has one more field: {', '.join(others)}",
        expected=f"the fields {', '.join(FIELDS)} and no other",
        next="remove it: the goal's status says whether it succeeded, and error_code says why not",
    )
    expect(
        METRE.search(_comments_of("distance_walked")),
        seen="distance_walked without a unit",
        expected="the unit in a comment, after the field or above it",
        next="write the comment # m, and between which two points the distance is measured",
    )
    return "the build will accept it: NONE, FELL, error_code, error_msg, and distance_walked with its unit"


def refuses_another_frame() -> str:
    """Call can_reach with a point in frame odom, then with one in frame shoulder."""
    try:
        from my_interfaces.srv import CanReach
    except ImportError:
        raise LabError("my_interfaces is not built: run the cell with lab.build_interfaces first") from None
    server = run_node("can_reach.py")
    hints = {"AttributeError": "fix the name: CanReach.srv has error_code, message and distance"}
    refused = call_student_service(
        server, "can_reach", CanReach, CanReach.Request(target=_point("odom")), hints=hints
    )
    codes = CanReach.Response
    expect(
        refused.error_code != codes.SUCCESS,
        seen="error_code SUCCESS for a point in frame odom",
        expected=f"FRAME_TRANSFORM_FAILURE, {codes.FRAME_TRANSFORM_FAILURE}",
        next="return response inside the `if`: without a return the callback goes on and ignores the frame",
    )
    expect(
        refused.error_code == codes.FRAME_TRANSFORM_FAILURE,
        seen=f"error_code {refused.error_code}",
        expected=f"FRAME_TRANSFORM_FAILURE, {codes.FRAME_TRANSFORM_FAILURE}",
        next="set response.error_code = CanReach.Response.FRAME_TRANSFORM_FAILURE",
    )
    expect(
        math.isnan(refused.distance),
        seen=f"distance {refused.distance}",
        expected="NaN, because the distance is unknown; a field that is not set is 0.0",
        next="set response.distance = math.nan",
    )
    expect(
        "odom" in refused.message,
        seen=f"message {refused.message!r}",
        expected="a message for people that names the frame odom",
        next="put the variable `frame` into response.message",
    )
    answered = call_student_service(
        server, "can_reach", CanReach, CanReach.Request(target=_point("shoulder")), hints=hints
    )
    expect(
        answered.error_code == codes.SUCCESS,
        seen=f"error_code {answered.error_code} for a point in frame shoulder",
        expected=f"SUCCESS, {codes.SUCCESS}",
        next="set the error code only inside the `if`",
    )
    return (
        f"for frame odom it responded error_code {refused.error_code} and distance nan, "
        f"for frame shoulder error_code {answered.error_code}"
    )


def _result() -> Part:
    """Return the result of the student's action.

    Raises GapError when the build would reject the definition.
    """
    try:
        definitions = checked_definitions(Path(PACKAGE), PACKAGE, os.environ)
    except InvalidDefinitions as error:
        wrong = [problem for problem in error.problems if problem.file.endswith(f"{ACTION}.action")]
        if not wrong:
            raise LabError(
                f"another definition of {PACKAGE} is wrong; correct it and run its cell first.\n{error}"
            ) from None
        first = wrong[0]
        if forgotten := re.match(r"\s*(uint16)\s+(NONE|FELL)\s+(\d+)", first.text):
            kind, name, value = forgotten.groups()
            raise not_yet(
                f"line {first.line}: {first.text}",
                f"{kind} {name}={value}",
                "put = between name and value, which makes it a constant",
            ) from None
        seen = f"line {first.line}: {first.text}: {first.wrong}" if first.line else first.wrong
        raise not_yet(seen, first.expected, "fix this line") from None
    return next(each for each in definitions if each.name == ACTION).parts["result"]


def _as_written(part: Part) -> str:
    constants = [f"{kind} {name}={value}" for name, (kind, value) in part.constants.items()]
    fields = [f"{kind} {name}" for name, kind in part.fields.items()]
    return f"in the result: {', '.join([*constants, *fields]) or 'nothing'}"


def _comments_of(field: str) -> str:
    """Return the line of a field of the result, with the comment lines above it."""
    lines = _section(Path(DEFINITION).read_text(encoding="utf-8").splitlines(), 1)
    at = next(number for number, line in enumerate(lines) if re.match(rf"\s*\S+\s+{field}\b", line))
    first = at
    while first > 0 and lines[first - 1].lstrip().startswith("#"):
        first -= 1
    return "\n".join(lines[first : at + 1])


def _section(lines: Sequence[str], number: int) -> list[str]:
    separators = [-1, *(at for at, line in enumerate(lines) if line.strip() == SEPARATOR), len(lines)]
    return list(lines[separators[number] + 1 : separators[number + 1]])


def _point(frame: str) -> PointStamped:
    point = PointStamped()
    point.header.frame_id = frame
    point.point.x, point.point.y = 0.4, 0.3
    return point


GAPS = (Gap(DEFINITION, has_a_result), Gap("can_reach.py", refuses_another_frame))
