"""Why a program is not handed in, or not all that a student has written: reasons, each in words."""

from __future__ import annotations

import warnings
from pathlib import Path

from autograder.engine.starter import is_starter
from autograder.engine.submission import Submission
from ros_runtime.project import WORK
from ros_runtime.self_checks import FILE, last_check_of


def flaw_of(path: Path, submission: Submission) -> str:
    """Return why a program can get no points: nothing is filled in, or Python cannot run it; "" if it may."""
    notebook = WORK / "exercises" / submission.exercise / f"{submission.exercise}.ipynb"
    if is_starter(submission, notebook, path):
        return (
            f"{path} is the starter as it was given out, which gets no points: write your code below "
            "# YOUR CODE HERE, save it with Ctrl+S, and run its cell"
        )
    error = syntax_error(submission)
    return f"Python cannot run {path}: {error}" if error else ""


def is_better(old: Path, work: Submission, new: Submission, flaw: str) -> bool:
    """Return whether an earlier program may get points and the new one cannot, or passed more visible checks."""
    if flaw:
        return not flaw_of(old, work)
    before, now = last_check_of(work.fingerprint, FILE), last_check_of(new.fingerprint, FILE)
    return before is not None and before.passed > (now.passed if now else 0)


def unsaved_program(path: Path, submission: Submission) -> str:
    """Return the file that a cell wrote after its notebook was saved, if it holds another program; else ""."""
    saved = path.stat().st_mtime
    for name, text in submission.sources.items() if path.is_file() and ".ipynb" in path.name.lower() else ():
        written = path.with_name(name)
        is_newer = written.is_file() and written.stat().st_mtime > saved
        if is_newer and written.read_text(encoding="utf-8", errors="replace").strip() != text.strip():
            return name
    return ""


def syntax_error(submission: Submission) -> str:
    """Return why Python cannot run a program, and in which line; "" if it can."""
    for name, text in submission.sources.items():
        try:
            if name.endswith(".py"):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    compile(text, name, "exec", dont_inherit=True)
        except SyntaxError as error:
            return f"line {error.lineno} of {name}: {error.msg}"
        except (MemoryError, RecursionError):
            return f"an expression in {name} is nested too deeply"
    return ""


def in_words(submission: Submission) -> str:
    """Return a program's fingerprint and, if it was checked, how the check ended."""
    checked = last_check(submission)
    return f"fingerprint {submission.fingerprint}" + (f": {checked}" if checked else "")


def last_check(submission: Submission) -> str:
    """Return how the last self-check of this program ended; "" if there was none."""
    last = last_check_of(submission.fingerprint, FILE)
    return f"{last.passed} of {last.total} visible checks passed" if last else ""
