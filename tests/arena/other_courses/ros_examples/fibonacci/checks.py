"""What students see of the judgement."""

from __future__ import annotations

from autograder.authoring import SUCCEEDED, Goal, Scenario, Transcript, check, expect, standard

ORDER = 5
COUNT = Scenario("count", {"order": ORDER}, robot=None)
CANCEL = Scenario("cancel", robot=None)
AGAIN = Scenario("count_after_a_cancel", {"order": 3}, robot=None)

server_appears = standard.server_appears("the action fibonacci", points=1, on=CANCEL)


def numbers(order: int) -> list[int]:
    """The sequence up to its number `order`, which 0 and 1 begin."""
    sequence = [0, 1]
    while len(sequence) <= order:
        sequence.append(sequence[-1] + sequence[-2])
    return sequence


def require_count(goal: Goal) -> None:
    """The goal succeeds with the right numbers."""
    result = goal.require_accepted().require_result(SUCCEEDED)
    wanted, got = numbers(goal.request.order), list(result.result.sequence)
    expect(
        got == wanted,
        expected=f"the sequence {wanted}, in which each number is the sum of the two before",
        observed=f"{got}",
        help="Begin with 0 and 1, and fill result.sequence.",
        at=result.t,
    )


@check(points=2, on=COUNT, needs=server_appears)
def counts(run: Transcript) -> None:
    """The goal SUCCEEDS with the sequence up to the number that was asked for"""
    require_count(run.goal("count"))


@check(points=1, on=COUNT, needs=counts)
def tells_how_far_it_is(run: Transcript) -> None:
    """Each feedback holds one number more"""
    told = [list(feedback.feedback.sequence) for feedback in run.goal("count").feedback]
    expect(
        told == [numbers(n) for n in range(2, ORDER + 1)],
        expected=f"{ORDER - 1} messages, each with one number more, from [0, 1, 1] on",
        observed=f"{told}",
        help="Append a number, then publish the sequence so far, once a step.",
    )


@check(points=3, on=CANCEL, needs=server_appears)
def can_be_cancelled(run: Transcript) -> None:
    """A goal that executes is CANCELED when its client asks"""
    run.goal("long").require_canceled()


@check(points=1, on=AGAIN, needs=can_be_cancelled)
def counts_again(run: Transcript) -> None:
    """After a cancel the next goal SUCCEEDS"""
    require_count(run.goal("count"))


ends_cleanly = standard.ends_cleanly(points=1, on=COUNT, needs=counts)
