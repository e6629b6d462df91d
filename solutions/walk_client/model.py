"""What must hold of every run of the walk client: what it sends, cancels and prints, and how it ends."""

from __future__ import annotations

from autograder.authoring.obligation import Obligation, obligation, whole_run
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking import client_obligations

sends_one_goal = obligation(1, 12, of=whole_run)(client_obligations.sends_one_goal)
prints_each_feedback = obligation(2, of=whole_run)(client_obligations.prints_each_feedback)
refuses_what_is_no_pose = obligation(11, of=whole_run)(client_obligations.refuses_what_is_no_pose)
asks_for_its_result = obligation(12, of=whole_run)(client_obligations.asks_for_its_result)


def follows_its_goal(*clauses: int) -> Obligation:
    """Return that it cancels, ends and says so as its goal went, for these clauses."""
    return obligation(*clauses, of=whole_run)(client_obligations.follows_its_goal)


EVERYTHING = (
    *(sends_one_goal, asks_for_its_result, prints_each_feedback),
    follows_its_goal(*range(3, 11), 12),
)


@obligation(*sorted({clause for each in EVERYTHING for clause in each.clauses}), of=whole_run)
def holds_whatever_happens(run: Transcript) -> str:
    """Whatever its server does and a person at its keyboard, it sends, prints, cancels and ends as the clauses say"""
    for each in EVERYTHING:
        each.judge(run)
    return ", ".join(EVERYTHING[-1].judge(run))
