"""Checks a definition, using the report of its build."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from autograder.authoring import Failure, Transcript, ev, expect, require_within_limits, unseen
from autograder.authoring.failure import CannotBeJudged

MAX_PROCESSOR_TIME = 60.0  # s; a correct file needs 25
NO_FILE = "there is no definition in this folder"  # the build's message for a missing file
MAX_QUOTE = 300  # characters quoted in a failure


def require_built(run: Transcript, wanted: Mapping[str, str] | None = None) -> dict[str, Any]:
    """Require that the file was built, and return its parts (request, …, feedback) with fields and constants.

    `wanted` are the fields in the task (name → ROS type), used to advise on a line that does not build.
    """
    try:
        return _built(run, wanted or {})
    except (
        AttributeError,
        KeyError,
        TypeError,
        ValueError,
    ) as error:  # the report comes from the student's sandbox
        raise unseen(run, f"the build's report is incomplete: {error!r}") from None


def _built(run: Transcript, wanted: Mapping[str, str]) -> dict[str, Any]:
    report, file = _report(run), run.params["file"]
    if report["built"]:
        (parts,) = report["types"].values()
        return parts
    problems, more = report["problems"], report["more"]
    if not problems:
        _require_time_for_it(run)
        raise CannotBeJudged(f"the build of a correct {file} failed: {report['log'][-2000:]}")
    first, more = problems[0], more + len(problems) - 1
    expect(
        first["wrong"] != NO_FILE,
        expected=f"a file {file}",
        observed="it was not handed in",
        help=f"Begin the cell with the definition with %%writefile {file}.",
    )
    place = f"line {first['line']}, “{first['text'].strip()}”: " if first["line"] else ""
    raise Failure(
        expected=f"{file} to build as part of an interface package",
        observed=f"{place}{first['wrong']}" + (f" (and {more:,} more)" if more else ""),
        help=_what_to_write(first, wanted),
    )


def require_fields(run: Transcript, part: str, wanted: Mapping[str, str]) -> None:
    """Require that one part of the definition has these fields (name → ROS type) and no others."""
    fields = _part(run, part)["fields"]
    others = sorted(set(fields) - set(wanted))
    for name, ros_type in wanted.items():
        expect(
            name in fields,
            expected=f"a field “{ros_type} {name}” in the {part}",
            observed=f"the {part} has {_listed(fields)}",
            help=_misplaced(run, part, "fields", name)
            or _misnamed(name, [other for other in others if fields[other] == ros_type])
            or f"Add the line “{ros_type} {name}” to the {part}.",
        )
        expect(
            fields[name] == ros_type,
            expected=f"“{ros_type} {name}” in the {part}",
            observed=f"“{fields[name]} {name}”",
            help=_why_this_type(ros_type, fields[name]),
        )
    expect(
        not others,
        expected=f"only {_listed(wanted)} in the {part}" if wanted else f"no fields in the {part}",
        observed=f"also {_cut(', '.join(others))}",
        help=f"Remove the field `{_cut(others[0]) if others else ''}`: every program would have to set and read it.",
    )


def require_constants(run: Transcript, part: str, ros_type: str, wanted: Mapping[str, int]) -> None:
    """Require that one part of the definition has these constants, of one type."""
    constants = _part(run, part)["constants"]
    for name, value in wanted.items():
        observed = constants.get(name)
        line = f"{ros_type} {name}={value}"
        expect(
            observed == {"type": ros_type, "value": value},
            expected=f"the constant “{line}” in the {part}",
            observed=f"“{observed['type']} {name}={str(observed['value'])[:MAX_QUOTE]}”"
            if observed
            else "no constant of that name",
            help=f"Write “{line}”: clients compare error_code with this constant."
            if observed
            else _misplaced(run, part, "constants", name)
            or f"Add the line “{line}” to the {part}. A comment is not enough, as programs cannot read it.",
        )


def _what_to_write(problem: Mapping[str, Any], wanted: Mapping[str, str]) -> str:
    """Return the next step for a problem of the build."""
    expected, line = problem["expected"], problem["line"]
    if line:
        name = problem["text"].partition("#")[0].split()[-1:]
        if name and name[0] in wanted:
            return f"Change line {line} to “{wanted[name[0]]} {name[0]}”."
        return f"Change line {line}. Expected: {expected}."
    number, _, shape = expected.partition(": ")
    if shape and number.isdigit():
        return f"Put {number} of these lines into the file: {shape}."
    return f"Change the file. Expected: {expected}."


def _misplaced(run: Transcript, part: str, what: str, name: str) -> str:
    """Return advice on a missing separator if a field or constant is in another part, else ""."""
    for other, content in require_built(run).items():
        if other != part and isinstance(content, dict) and name in (content.get(what) or {}):
            return f"`{name}` is in the {other}: check whether a --- is missing or misplaced."
    return ""


def _misnamed(name: str, candidates: Sequence[str]) -> str:
    """Return advice on a misspelt name if exactly one other field has the same type, else ""."""
    if len(candidates) != 1:
        return ""
    return f"Rename `{_cut(candidates[0])}` to `{name}`: programs access a field by its exact name."


def _why_this_type(wanted: str, written: str) -> str:
    if wanted.endswith("Stamped"):
        return f"Write {wanted}: without a header the frame of the numbers is unknown."
    return f"Write {wanted}: {_cut(written)} is a different type, and programs with the two types cannot communicate."


def _part(run: Transcript, part: str) -> Any:
    found = require_built(run).get(part)
    is_whole = (
        isinstance(found, dict)
        and isinstance(found.get("fields"), dict)
        and isinstance(found.get("constants"), dict)
        and all({"type", "value"} <= set(constant) for constant in found["constants"].values())
    )
    if not is_whole:
        raise unseen(run, f"the build's report on the {part} is incomplete")
    return found


def _report(run: Transcript) -> dict[str, Any]:
    """Return the report that the build printed at its end; a `Failure` if the file kept the build from finishing."""
    try:
        return json.loads(run.output("stdout"))
    except ValueError:
        require_within_limits(run)
        _require_time_for_it(run)
        raise unseen(
            run, f"the build printed no report: {run.last_words or 'nothing on stderr either'}"
        ) from None


def _require_time_for_it(run: Transcript) -> None:
    """Require that the build did not use more time than any correct file needs."""
    usage = run.first(ev.NodeUsage)
    if usage and usage.cpu > MAX_PROCESSOR_TIME:
        raise Failure(
            expected=f"{run.params['file']} to build within some seconds",
            observed=f"its build was stopped after {usage.cpu:.0f} s of processor time",
            help="Leave out everything that the task does not require, such as arrays of a fixed size: it takes time "
            "to compile.",
        )


def _listed(fields: Mapping[str, str]) -> str:
    return _cut(", ".join(f"{ros_type} {name}" for name, ros_type in fields.items())) or "no fields"


def _cut(text: str) -> str:
    return text if len(text) <= MAX_QUOTE else f"{text[:MAX_QUOTE]}…"
