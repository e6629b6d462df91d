"""Grades a generated program, and after it a correct one, which must still pass every check."""

from __future__ import annotations

import traceback
from dataclasses import replace
from functools import cache
from pathlib import Path

from autograder.classroom.audit.known_submission import known_submission
from autograder.engine.exercise import Exercise, load_exercise
from autograder.engine.grading import GradingOptions, grade
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from fuzz.arena.targets import TARGETS, Target
from leftovers import leftovers

PROGRAM = Path(__file__).with_name("wild_program.py")
MESSAGES = Path(__file__).with_name("wild_messages.py")
TRIES = 2  # a busy machine may fail a grading once


def program(target: Target, seed: int) -> str:
    """Return the source of the program of a seed."""
    source = PROGRAM.read_text(encoding="utf-8")
    messages = MESSAGES.read_text(encoding="utf-8").partition("from __future__ import annotations\n")[2]
    return (
        source.replace("SEED = 0", f"SEED = {seed}", 1)
        .replace("OFFERS: tuple = ()", f"OFFERS = {tuple(target.offers)!r}", 1)
        .replace("from fuzz.arena.wild_messages import wild_message\n", messages, 1)
    )


def find_problem(name: str, seed: int) -> str:
    """Grade the program of this seed and a correct one after it; return what went wrong, or ""."""
    target = TARGETS[name]
    source = program(target, seed)
    problem = ""
    for _ in range(TRIES):
        try:
            problem = _problem(target, source, seed)
        except Exception:  # anything that the grader raises is a finding
            problem = traceback.format_exc()
        if not problem:
            return ""
    return f"{name}, seed {seed}: {problem}\n\n{source}"


def _problem(target: Target, source: str, seed: int) -> str:
    """Return what was wrong, or ""."""
    exercise = _exercise(target)
    (file,) = exercise.file_names
    options = GradingOptions(seed, jobs=1)
    with leftovers() as left:
        submission = Submission(target.exercise, "wild", {file: source})
        wild = grade(submission, exercise, replace(options, checks_without_retry=target.checks))
    if wild.status != "graded":
        return f"the generated program was not graded:\n{_in_words(wild)}"
    if wild.all_passed:
        return f"the generated program has full marks:\n{_in_words(wild)}"
    if left:
        return f"it left behind: {', '.join(left)}"
    with leftovers() as left:
        correct = grade(known_submission(target.exercise, target.correct).read(), exercise, options)
    if not correct.all_passed:
        return f"the correct program after it lost points:\n{_in_words(correct)}"
    return f"the correct program after it left behind: {', '.join(left)}" if left else ""


@cache
def _exercise(target: Target) -> Exercise:
    exercise = load_exercise(target.exercise, hidden=True)
    return replace(exercise, checks=[check for check in exercise.checks if check.id in target.checks])


def _in_words(grade: Grade) -> str:
    lines = [f"{each.id}: {each.status}: {each.observed or each.help}"[:1500] for each in grade.checks]
    return "\n".join([*([grade.reason] if grade.reason else []), *lines])
