"""A faulty submission as a patch of a correct one: a header, and a unified diff of the program below its docstring.

Fault: sleeps in the callback (M2)
Caught by: answers_in_time

--- correct/class_based.py
+++ faulty/sleeps_in_the_callback.py
@@ -21,4 +21,5 @@
…
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Sequence
from pathlib import Path

import whatthepatch
from whatthepatch.exceptions import WhatThePatchException

from ros_runtime.course_error import CourseError

SUFFIX = ".patch"
MAX_CHANGED_SHARE = 0.6  # share of a program's lines; if more differ, the whole file is clearer than a diff
_CONTEXT = 2  # lines around a change
# matches in files with syntax errors, too
DOCSTRING = re.compile(r'\A(?:#.*\n|\s)*"""(.*?)"""\n?', re.DOTALL)
_DIFF_START = re.compile(r"^--- (\S+)", re.MULTILINE)


def header_of(text: str) -> str:
    """Return the text before the diff."""
    found = _DIFF_START.search(text)
    return text[: found.start()] if found else text


def whole_program(path: Path) -> str:
    """Apply a patch in known/<kind>/ to the submission it names; return the program, with the patch's header.

    Raises `CourseError` when the patch does not apply; the message says what to do.
    """
    text = path.read_text(encoding="utf-8")
    found = _DIFF_START.search(text)
    base = path.parents[1] / found[1] if found else path
    if not found or not base.is_file():
        raise CourseError(
            f"{path}: the line --- must name the correct submission to change, such as correct/class_based.py"
        )
    try:
        (change,) = whatthepatch.parse_patch(text[found.start() :])
        body = whatthepatch.apply_diff(change, _below_the_docstring(base).splitlines())
    except (WhatThePatchException, ValueError) as error:
        raise CourseError(
            f"{path} no longer applies to {found[1]}: {error}. Write the whole program as {path.stem}.py, remove "
            f"{path.name}, and run ./course audit {path.parents[2].name} --to-patch {path.stem}"
        ) from error
    return f'"""{header_of(text).strip()}\n"""\n' + "\n".join(body) + "\n"


def as_patch(program: Path, correct: Sequence[Path]) -> str | None:
    """Return the shortest patch that turns a `correct` program into `program`; None if too many lines differ."""
    docstring = DOCSTRING.match(program.read_text(encoding="utf-8"))
    if docstring is None or not correct:
        return None
    body = _below_the_docstring(program).splitlines()

    def changes_from(base: Path) -> list[str]:
        old, new = (f"{path.parent.name}/{path.name}" for path in (base, program))
        before = _below_the_docstring(base).splitlines()
        return list(difflib.unified_diff(before, body, old, new, n=_CONTEXT, lineterm=""))

    shortest = min(map(changes_from, correct), key=len)
    if len(shortest) > MAX_CHANGED_SHARE * len(body):
        return None
    return docstring[1].strip() + "\n\n" + "\n".join(shortest) + "\n"


def _below_the_docstring(program: Path) -> str:
    text = program.read_text(encoding="utf-8")
    found = DOCSTRING.match(text)
    return text[found.end() :] if found else text
