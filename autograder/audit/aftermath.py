"""What a submission does to the machine and to the one that is graded after it: nothing, if arenas are sound."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from autograder.audit.known_submission import KnownSubmission, known_submissions, require_known_checks
from autograder.audit.residue import residue
from autograder.audit.run import AuditedRun, audit_one
from autograder.engine.exercise import load_exercise


@dataclass(frozen=True)
class Aftermath:
    """A graded submission, what it `left` on the machine, each in words, and the correct one graded right after it."""

    run: AuditedRun
    left: tuple[str, ...]
    next_run: AuditedRun

    def harm(self) -> list[str]:
        """Describe what is otherwise than if the submission had never been graded; empty if nothing is."""
        next_one = self.next_run.known.name
        return [
            *(f"left behind: {line}" for line in self.left),
            *(f"the next one, {next_one}: {surprise}" for surprise in self.next_run.surprises()),
        ]


def audit_one_by_one(
    submissions: Sequence[KnownSubmission],
    exercise_name: str,
    *,
    report: Callable[[Aftermath], None] = lambda aftermath: None,
) -> list[Aftermath]:
    """Grade each submission alone, with every check, and after it a correct one, with the visible ones.

    Alone, because what is left could else not be told from what another one still uses.
    """
    whole, visible = load_exercise(exercise_name, hidden=True), load_exercise(exercise_name, hidden=False)
    for known in submissions:
        require_known_checks(known, [check.id for check in whole.checks])
    correct = known_submissions(exercise_name, only="correct/*")[0]
    every_aftermath = []
    for known in submissions:
        with residue() as left:
            run = audit_one(known, whole)
        aftermath = Aftermath(run, tuple(left), audit_one(correct, visible))
        report(aftermath)
        every_aftermath.append(aftermath)
    return every_aftermath
