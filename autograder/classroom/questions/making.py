"""Makes the questions for one student: grades the program, runs its traced copy, and grades changed copies."""

from __future__ import annotations

import hashlib
import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import count
from typing import Literal, TypeVar

from autograder.classroom.questions.changes import Change, changes, executor_changes
from autograder.classroom.questions.moments import moments
from autograder.classroom.questions.question import Part, Question, Sheet
from autograder.classroom.questions.student_program import StudentProgram, UnreadableProgram
from autograder.classroom.questions.traced import traced
from autograder.engine.arena_run import ArenaRun, NotGraded, run_in_arena
from autograder.engine.exercise import Exercise
from autograder.engine.grading import VISIBLE_SEED, GradingOptions, Watcher, grade
from autograder.engine.stop import Stop
from autograder.engine.submission import Submission
from autograder.engine.verdict import CheckVerdict
from ros_runtime.drawing.svg import shorten

MOST_CHANGES = 8  # changed copies that are graded for each kind of question
MOST_RUNS = 6  # scenarios of the traced copy
ENOUGH_FAILED = 2  # failed checks that a key names; after them a changed copy is not graded further
LONGEST_TEXT = 250  # characters of what a check expected or observed
_CLAUSE = re.compile(r"(?:^clauses? |”\), )(\d+)")  # in a verdict's promise
_Item = TypeVar("_Item")


class _SeenEnough(Exception):
    """Raised to end the grading of a changed copy."""


@dataclass(frozen=True)
class Maker:
    """Makes the questions for one student of an exercise, whose hidden checks must not be loaded.

    `number` questions are wanted; `stop` ends the arenas at once when it is set; `say` receives what is being done.
    """

    exercise: Exercise
    submission: Submission
    number: int = 3
    stop: Stop | None = None
    say: Callable[[str], object] = lambda doing: None

    def sheet(self) -> Sheet:
        """Return the questions; raises `Stopped` when `stop` is set."""
        (text,) = self.submission.sources.values()
        sheet = Sheet(self.submission.student, self.exercise.name, text)
        try:
            program = StudentProgram(text)
        except UnreadableProgram as error:
            return replace(sheet, note=f"no questions: the program cannot be read: {error}")
        self.say("grades the program")
        before = self._verdicts(text)
        passed = {one.id for one in before if one.status == "passed"}
        errors = [one.help for one in before if one.status == "error"]
        if errors or not passed:
            reason = [*errors, "the program passes no check"][0]
            return replace(sheet, note=f"no questions: {reason.splitlines()[0]}")
        questions = self._questions(program, passed)
        few = f"{len(questions)} of {self.number} questions: the others would have no sure key"
        return replace(sheet, questions=questions, note=few if len(questions) < self.number else "")

    def _questions(self, program: StudentProgram, passed: set[str]) -> tuple[Question, ...]:
        """Choose one question of each kind, then changes, then moments, each about another line and moment."""
        offers = bool(program.callbacks("service", "execute"))
        of_moments = self._moments(program)
        of_executor = self._effects(executor_changes(program), passed, offers)
        of_changes = self._effects(changes(program), passed, offers)
        chosen: dict[int, Question] = {}
        for source in (of_moments, of_executor, *[of_changes] * self.number, *[of_moments] * self.number):
            if len(chosen) < self.number:
                told = {one.situation for one in chosen.values()} - {""}
                unlike = (one for one in source if one.line not in chosen and one.situation not in told)
                question = next(unlike, None)
                chosen |= {question.line: question} if question else {}
        return tuple(chosen.values())

    def _moments(self, program: StudentProgram) -> Iterator[Question]:
        """Run the traced copy in scenarios of the visible checks, and yield questions about what happened."""
        scenarios = dict.fromkeys(scenario for check in self.exercise.checks for scenario in check.on)
        copy = self._copy(traced(program))
        for scenario in self._in_order(scenarios, lambda one: str(one.inputs))[:MOST_RUNS]:
            self.say("runs the traced copy")
            with suppress(NotGraded):
                run = run_in_arena(ArenaRun(self.exercise, copy.files, scenario, VISIBLE_SEED), self.stop)
                yield from self._in_order(moments(program, run), _words)

    def _effects(self, made: Iterable[Change], passed: set[str], offers: bool) -> Iterator[Question]:
        """Grade changed copies, and yield questions about those that fail checks which the program itself passes.

        A change after which nothing works is left out, as there is little to explain.
        """
        roots = {check.id for check in self.exercise.checks if not check.needs}
        for change in self._in_turn(made)[:MOST_CHANGES]:
            self.say(f"grades a change of line {change.line}")
            after = self._verdicts(change.text, passed)
            failed = [one for one in after if one.status == "failed" and one.id in passed]
            has_error = any(one.status == "error" for one in after)
            if failed and not has_error and roots.isdisjoint(one.id for one in failed):
                yield _question(change, failed, "a client" if offers else "the user, or the server,")

    def _verdicts(self, text: str, passed: set[str] | None = None) -> list[CheckVerdict]:
        """Grade a text; if it is that of a changed copy, until enough checks fail that `passed` before."""
        found: list[CheckVerdict] = []

        def report(verdict: CheckVerdict) -> None:
            found.append(verdict)
            failed = [one for one in found if one.status == "failed" and one.id in (passed or ())]
            if len(failed) == ENOUGH_FAILED:
                raise _SeenEnough

        with suppress(_SeenEnough):
            options = GradingOptions(jobs=1, shortens=False)
            grade(self._copy(text), self.exercise, options, Watcher(report), stop=self.stop)
        return found

    def _copy(self, text: str) -> Submission:
        return replace(self.submission, sources=dict.fromkeys(self.submission.sources, text))

    def _in_order(self, items: Iterable[_Item], words: Callable[[_Item], str]) -> list[_Item]:
        """Put items in an order that depends only on the student, the exercise and the items' words."""
        name = f"{self.submission.student}\0{self.exercise.name}\0"
        return sorted(items, key=lambda item: hashlib.sha256((name + words(item)).encode()).digest())

    def _in_turn(self, made: Iterable[Change]) -> list[Change]:
        """Return changes in the student's order, from each operator in turn."""
        turns: defaultdict[str, Iterator[int]] = defaultdict(count)
        in_order = self._in_order(made, lambda one: f"{one.operator} {one.line} {one.supposed}")
        return sorted(in_order, key=lambda one: next(turns[one.operator]))


def _words(question: Question) -> str:
    """Return what tells a question from others, without the times, which differ a little from run to run."""
    return f"{question.line} {[part.asked for part in question.parts]}"


def _question(change: Change, failed: Sequence[CheckVerdict], who: str) -> Question:
    """Return the question on a change after which these checks fail."""
    key = " ".join(filter(None, (*map(_seen, failed), change.why)))
    effect = f"Which clause of the task would be broken, what would {who} see, and why?"
    kind: Literal["executor", "change"] = "executor" if change.why else "change"
    return Question(kind, change.line, "", (*change.first, Part(f"Suppose {change.supposed}. {effect}", key)))


def _seen(verdict: CheckVerdict) -> str:
    numbers = _CLAUSE.findall(verdict.promise)
    clauses = f"clause{'s' if numbers[1:] else ''} {', '.join(numbers)}: " if numbers else ""
    when = f" (at {verdict.robot_time:.1f} s)" if verdict.robot_time is not None else ""
    observed, *steps = verdict.observed.partition("; steps: ")
    expected, observed = shorten(verdict.expected, LONGEST_TEXT), shorten(observed, LONGEST_TEXT)
    seen = f"expected {expected}; observed {observed}{''.join(steps)}{when}."
    return f"{clauses}“{verdict.title}”: {seen}"
