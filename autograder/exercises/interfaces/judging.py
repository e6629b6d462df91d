"""How a definition is judged: what the build reported about it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from autograder.checks import Failure, expect
from autograder.transcript import Transcript


def require_built(run: Transcript) -> dict[str, Any]:
    """The file was built; returns its parts (request, response; goal, result, feedback) with fields and constants."""
    report = json.loads(_last_line(run.output("stdout")))
    file = run.params["file"]
    if report["built"]:
        (parts,) = report["types"].values()
        return parts
    problems = report["problems"]
    if not problems:
        raise RuntimeError(f"the build of a sound {file} failed: {report['log'][-2000:]}")
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
    fields = require_built(run)[part]["fields"]
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
    constants = require_built(run)[part]["constants"]
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


def _last_line(text: str) -> str:
    """Return the last line that is not blank."""
    return [line for line in text.splitlines() if line.strip()][-1]


def _listed(fields: Mapping[str, str]) -> str:
    return ", ".join(f"{ros_type} {name}" for name, ros_type in fields.items()) or "no fields"
