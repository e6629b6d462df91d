'''Obligations, the model of an exercise: what must hold for every answer, message and goal in any scenario.

@obligation(1, of=calls("is_upright"))
def tells_the_truth(call: Call) -> str | None:
    """`success` says whether the robot is on its feet"""
    mode = call.run.robot_at(call.sent.t).mode
    if mode == RobotState.OFF:
        return None  # the clause does not cover this state
    call.expect("success", mode != RobotState.FALLEN, because="…", help="…")
    return "fallen" if mode == RobotState.FALLEN else "upright"  # the situation that was judged

A check consists of one or more obligations and has a name, points and a lesson:

tells_that_it_stands = check_of(tells_the_truth, on=ASK, needs=server_appears)
'''

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from autograder.authoring.checks import Check, Scenario, check_by
from autograder.authoring.diagnosis.goal_diagnosis import how_goals_ended
from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call
from autograder.authoring.evidence.goal import Goal
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, NoOccasion
from autograder.authoring.sequence import require_all_steps

Situation = str  # what distinguishes an occasion from others, in words for the table of clauses


@dataclass(frozen=True, eq=False)
class Obligation:
    """A requirement from clauses of the statement on each occasion in a run: each call, each goal, or the run itself.

    Attributes:
        name: of the function.
        sentence: what it requires, in words.
        clauses: the numbers of the clauses.
        occasions: finds the occasions in a run.
        require: judges an occasion: raises a Failure or returns the situation; None: the obligation does not apply.
        see: the lesson for a failure: CHAPTER#cell, or a URL.
    """

    name: str
    sentence: str
    clauses: tuple[int, ...]
    occasions: Callable[[Transcript], Iterable[Any]] = field(repr=False)
    require: Callable[[Any], Situation | None] = field(repr=False)
    see: str = ""

    def judge(self, run: Transcript) -> Counter[Situation]:
        """Judge every occasion in the run; return the number of judged occasions by situation."""
        situations = (self.require(occasion) for occasion in self.occasions(run))
        return Counter(situation for situation in situations if situation is not None)


def obligation(
    *clauses: int, of: Callable[[Transcript], Iterable[Any]], see: str = ""
) -> Callable[[Callable[[Any], Situation | None]], Obligation]:
    """Make an obligation of the decorated function, whose docstring says what must hold.

    `of` finds the occasions in a run; `see` is the lesson for failures.
    """

    def make(require: Callable[[Any], Situation | None]) -> Obligation:
        if not require.__doc__:
            raise ValueError(f"the obligation {require.__name__} needs a docstring: it says what must hold")
        sentence = require.__doc__.strip().splitlines()[0].rstrip(".")
        return Obligation(require.__name__, sentence, clauses, of, require, see)

    return make


def calls(service: str) -> Callable[[Transcript], list[Call]]:
    """Occasions: every call of a service."""

    def find(run: Transcript) -> list[Call]:
        _require_sent(
            run, {answer.call for answer in run.all(ev.ServiceAnswered)}, run.all(ev.ServiceCalled), "call"
        )
        return [call for call in run.calls if call.service == service]

    return find


def goals(run: Transcript) -> list[Goal]:
    """Occasions: every goal that was sent."""
    sent = run.all(ev.GoalSent)
    _require_sent(run, {answer.goal for answer in run.all(ev.GoalAnswered)}, sent, "goal")
    return run.goals


def _require_sent(run: Transcript, answered: set[str], sent: Sequence[Any], key: str) -> None:
    """Require that the record contains each call or goal that was answered."""
    if lost := answered - {getattr(each, key) for each in sent}:
        raise unseen(run, f"the record lacks the {key} “{min(lost)}”, which was answered")


def whole_run(run: Transcript) -> list[Transcript]:
    """The one occasion: the run itself."""
    return [run]


def check_of(
    obligations: Obligation | Sequence[Obligation],
    *,
    points: int = 1,
    on: Scenario | Sequence[Scenario],
    needs: Check | Sequence[Check] = (),
    title: str = "",
    see: str = "",
    to_its_end: bool = True,
) -> Check:
    """Make a check of obligations. In each scenario of `on`, each obligation must have an occasion and must hold.

    Args:
        obligations: one or several.
        points: for all of them together.
        on: the scenarios; only those in which the submission failed are retried.
        needs: checks that must pass first.
        title: of the check; by default the sentence of the first obligation.
        see: the lesson for failures; by default that of the obligation that failed, or of the first.
        to_its_end: whether every step of a scenario must have been carried out.
    """
    judged = (obligations,) if isinstance(obligations, Obligation) else tuple(obligations)

    def judge(run: Transcript) -> None:
        for each in judged:
            try:
                occasions = each.judge(run)
            except Failure as failure:
                failure.see = failure.see or see or each.see
                raise
            if not occasions:
                require_all_steps(run)
                raise NoOccasion(each.sentence, how_goals_ended(run))
        if to_its_end:
            require_all_steps(run)

    return check_by(
        judge,
        title or judged[0].sentence,
        points=points,
        on=on,
        needs=needs,
        see=see or judged[0].see,
        clauses=sorted({clause for each in judged for clause in each.clauses}),
        obligations=judged,
    )
