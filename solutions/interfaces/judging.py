"""Judges a definition by what the build reported about it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from autograder.authoring import Failure, Transcript, ev, expect, require_within_limits, unseen
from autograder.authoring.failure import CannotBeJudged

BUSY = 60.0  # s of processor time; a correct file needs 25
NO_FILE = "there is no definition in this folder"  # what the build says then
LONGEST = 300  # characters of what a verdict quotes


def require_built(run: Transcript, wanted: Mapping[str, str] | None = None) -> dict[str, Any]:
    """Require that the file was built, and return its parts (request, …, feedback) with fields and constants.

    `wanted` are the fields that the task asks for (name → ROS type), for a line that does not build.
    """
    try:
        return _built(run, wanted or {})
    except (AttributeError, KeyError, TypeError, ValueError) as error:  # it comes from the student's sandbox
        raise unseen(run, f"the build's report is not whole: {error!r}") from None


def _built(run: Transcript, wanted: Mapping[str, str]) -> dict[str, Any]:
    report, file = _report(run), run.params["file"]
    if report["built"]:
        (parts,) = report["types"].values()
        return parts
    problems, more = report["problems"], report["more"]
    if not problems:
        _require_time_for_it(run)
        raise CannotBeJudged(f"the build of a sound {file} failed: {report['log'][-2000:]}")
    first, more = problems[0], more + len(problems) - 1
    expect(
        first["wrong"] != NO_FILE,
        expected=f"a file {file}",
        observed="it was not handed in",
        help=f"Begin the cell that holds it with %%writefile {file}.",
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
        expected=f"nothing in the {part} but {_listed(wanted) if wanted else 'an empty part'}",
        observed=f"also {_cut(', '.join(others))}",
        help=f"Remove `{_cut(others[0]) if others else ''}`: everybody would have to fill and read it.",
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
            observed=f"“{observed['type']} {name}={str(observed['value'])[:LONGEST]}”"
            if observed
            else "no constant of that name",
            help=f"Write “{line}”: clients compare the number with that name."
            if observed
            else _misplaced(run, part, "constants", name)
            or f"Add the line “{line}” to the {part}: a comment is for people, programs cannot read it.",
        )


def _what_to_write(problem: Mapping[str, Any], wanted: Mapping[str, str]) -> str:
    """Return the next step for a problem of the build."""
    expected, line = problem["expected"], problem["line"]
    if line:
        name = problem["text"].partition("#")[0].split()[-1:]
        if name and name[0] in wanted:
            return f"Change line {line} to “{wanted[name[0]]} {name[0]}”."
        return f"Change line {line}. What belongs there: {expected}."
    number, _, shape = expected.partition(": ")
    if shape and number.isdigit():
        return f"Put {number} of these lines into it: {shape}."
    return f"Change the file. What it needs: {expected}."


def _misplaced(run: Transcript, part: str, what: str, name: str) -> str:
    """Ask for the separator when a field or constant stands in another part, else return ""."""
    for other, content in require_built(run).items():
        if other != part and isinstance(content, dict) and name in (content.get(what) or {}):
            return f"`{name}` is in the {other}. Is a --- missing or misplaced?"
    return ""


def _misnamed(name: str, candidates: Sequence[str]) -> str:
    """Ask for the task's name when a single other field of the same type may be meant, else return ""."""
    if len(candidates) != 1:
        return ""
    return f"Rename `{_cut(candidates[0])}` to `{name}`: programs find a field by its name, letter by letter."


def _why_this_type(wanted: str, written: str) -> str:
    if wanted.endswith("Stamped"):
        return f"Write {wanted}: without the header nobody can say in which frame the numbers are."
    return f"Write {wanted}: for a program {_cut(written)} is another type, and the two do not fit together."


def _part(run: Transcript, part: str) -> Any:
    found = require_built(run).get(part)
    is_whole = (
        isinstance(found, dict)
        and isinstance(found.get("fields"), dict)
        and isinstance(found.get("constants"), dict)
        and all({"type", "value"} <= set(constant) for constant in found["constants"].values())
    )
    if not is_whole:
        raise unseen(run, f"the build did not say all of the {part}")
    return found


def _report(run: Transcript) -> dict[str, Any]:
    """Read what the build printed at its end; it is a Failure if the file kept it from coming there."""
    try:
        return json.loads(run.output("stdout"))
    except ValueError:
        require_within_limits(run)
        _require_time_for_it(run)
        raise unseen(run, f"the build said nothing: {run.last_words or 'nothing on stderr either'}") from None


def _require_time_for_it(run: Transcript) -> None:
    """Require that the build has not used more time than any correct file needs."""
    usage = run.first(ev.NodeUsage)
    if usage and usage.cpu > BUSY:
        raise Failure(
            expected=f"{run.params['file']} to build within some seconds",
            observed=f"its build was ended after {usage.cpu:.0f} s of a processor",
            help="Leave out what the task does not ask for, such as arrays of a fixed size: all of it is compiled.",
        )


def _listed(fields: Mapping[str, str]) -> str:
    return _cut(", ".join(f"{ros_type} {name}" for name, ros_type in fields.items())) or "no fields"


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"
