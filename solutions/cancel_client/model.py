"""What must hold of every run of the cancel client: all that a walk client owes, and what a q does."""

from __future__ import annotations

from autograder.authoring.obligation import Obligation, obligation, whole_run
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking import client_obligations

sends_one_goal = obligation(1, of=whole_run)(client_obligations.sends_one_goal)
prints_each_feedback_in_time = obligation(1, 9, of=whole_run)(client_obligations.prints_feedback_in_time)
says_what_was_refused = obligation(6, 7, of=whole_run)(client_obligations.says_what_was_refused)
refuses_what_is_no_pose = obligation(1, of=whole_run)(client_obligations.refuses_what_is_no_pose)


def follows_its_goal(*clauses: int) -> Obligation:
    """Return that it cancels, ends and says so as its goal went, for these clauses."""
    return obligation(*clauses, of=whole_run)(client_obligations.follows_its_goal)


EVERYTHING = (
    *(sends_one_goal, prints_each_feedback_in_time, says_what_was_refused),
    follows_its_goal(*range(1, 9)),
)


@obligation(*sorted({clause for each in EVERYTHING for clause in each.clauses}), of=whole_run)
def holds_whatever_happens(run: Transcript) -> str:
    """Whatever its server does and a person at its keyboard, it sends, prints, cancels and ends as the clauses say"""
    for each in EVERYTHING:
        each.judge(run)
    return ", ".join(EVERYTHING[-1].judge(run))
