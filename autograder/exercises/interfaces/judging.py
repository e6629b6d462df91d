"""How a definition is judged: what the build reported about it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from autograder import events as ev
from autograder.checks import CannotBeJudged, Failure, expect
from autograder.missing import unseen
from autograder.readiness import require_within_limits
from autograder.transcript import Transcript


def require_built(run: Transcript) -> dict[str, Any]:
    """The file was built; returns its parts (request, response; goal, result, feedback) with fields and constants."""
    report, file = _report(run), run.params["file"]
    if report["built"]:
        (parts,) = report["types"].values()
        return parts
    problems = report["problems"]
    if not problems:
        raise CannotBeJudged(f"the build of a sound {file} failed: {report['log'][-2000:]}")
    first = problems[0]
    place = f"line {first['line']}, “{first['text'].strip()}”: " if first["line"] else ""
    raise Failure(
        expected=f"{file} to build as part of an interface package",
        observed=f"{place}{first['wrong']}"
        + (f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""),
        help=f"Expected here: {first['expected']}",
    )


def require_fields(run: Transcript, part: str, wanted: Mapping[str, str]) -> None:
    """One part of the definition has these fields (name → ROS type) and no others."""
    fields = _part(run, part)["fields"]
    for name, ros_type in wanted.items():
        expect(
            name in fields,
            expected=f"a field “{ros_type} {name}” in the {part}",
            observed=f"the {part} has {_listed(fields)}",
            help="Names are compared letter by letter; the parts stand in the task's order, with --- between them.",
        )
        expect(
            fields[name] == ros_type,
            expected=f"“{ros_type} {name}” in the {part}",
            observed=f"“{fields[name]} {name}”",
            help="The type decides what a message can say: a pose without a header has no frame, a float64 is another "
            "type than a float32.",
        )
    others = sorted(set(fields) - set(wanted))
    expect(
        not others,
        expected=f"nothing in the {part} but {_listed(wanted) if wanted else 'an empty part'}",
        observed=f"also {', '.join(others)}",
        help="Whoever uses the interface has to fill and read every field: leave out what the task does not name.",
    )


def require_constants(run: Transcript, part: str, ros_type: str, wanted: Mapping[str, int]) -> None:
    """One part of the definition has these constants, of one type."""
    constants = _part(run, part)["constants"]
    for name, value in wanted.items():
        observed = constants.get(name)
        expect(
            observed == {"type": ros_type, "value": value},
            expected=f"the constant “{ros_type} {name}={value}” in the {part}",
            observed=f"“{observed['type']} {name}={observed['value']}”"
            if observed
            else "no constant of that name",
            help="A constant is a line TYPE NAME=VALUE in the part where it is used, its name in capitals.",
        )


def _part(run: Transcript, part: str) -> dict[str, Any]:
    parts = require_built(run)
    if part not in parts:
        raise unseen(run, f"the build said nothing of the {part}")
    return parts[part]


def _report(run: Transcript) -> dict[str, Any]:
    """Read what the build printed at its end, which it must have come to."""
    require_within_limits(run)
    exited = run.first(ev.NodeExited)
    lines = [line for line in run.output("stdout").splitlines() if line.strip()]
    if exited is None or not lines:
        raise unseen(run, f"the build said nothing: {run.last_words or 'nothing on stderr either'}")
    try:
        return json.loads(lines[-1])
    except ValueError:
        raise Failure(
            expected=f"a {run.params['file']} with the few lines that the task asks for",
            observed="so much is wrong with it that the report on it has no end",
            help="Write the fields by hand, one a line, and build it again.",
            at=exited.t,
        ) from None


def _listed(fields: Mapping[str, str]) -> str:
    return ", ".join(f"{ros_type} {name}" for name, ros_type in fields.items()) or "no fields"
