"""Obligations for every service. Each takes one line in an exercise's model.

answers_in_time = answered_within(2.0, "get_battery_status", clause=4)
never_waits = answers_without_waiting("get_battery_status", lambda call: "known" if … else "unknown", clause=4)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.obligation import Obligation, calls, obligation, whole_run

# s on the arena's clock, which runs up to 10 times faster than real time. An answer from memory takes a few ms of real
# time. Only the fastest of several answers is judged, because a busy machine does not delay all of them.
FROM_MEMORY_TIME = 0.6
TOGETHER_TIME = 0.5  # s; requests at a shorter distance count as sent together
MIN_ANSWERS = 3  # of which the fastest is judged
FROM_MEMORY = "Answer from memory: the callback must not sleep or wait for the next message."


def one_or_several(call: Call) -> str:
    """Return whether a request was sent alone, or together with others to the same service."""
    sent = [each.t for each in call.run.all(ev.ServiceCalled) if each.service == call.service]
    together = sum(abs(t - call.sent.t) < TOGETHER_TIME for t in sent)
    return "one at a time" if together == 1 else "several together"


def answered_within(timeout: float, service: str, *, clause: int, help: str = FROM_MEMORY) -> Obligation:
    """Make the obligation that every request is answered within `timeout` (s), however many come together."""

    def answers_in_time(call: Call) -> str:
        answered = call.answered_within(timeout)
        call.require(
            answered.t - call.sent.t <= timeout,
            expected=f"an answer within {timeout:g} s",
            observed=f"it took {call.latency:.1f} s",
            help=help,
        )
        return one_or_several(call)

    answers_in_time.__doc__ = f"Every request is answered within {timeout:g} s, also when many come together"
    return obligation(clause, of=calls(service))(answers_in_time)


def require_fastest(answers: Sequence[Call], limit: float, *, expected: str, help: str) -> None:
    """Require that the fastest of several answers took no longer than `limit` (s)."""
    fastest = min(answers, key=lambda call: call.answered.t - call.sent.t)
    fastest.require(
        fastest.latency <= limit,
        expected=expected,
        observed=f"the fastest of {len(answers)} took {fastest.latency:.1f} s",
        help=help,
    )


def enough_answers(answers: Sequence[Call], situation: Callable[[Call], str | None]) -> dict[str, list[Call]]:
    """Return the answers of each situation that has enough of them to judge the fastest."""
    found: dict[str, list[Call]] = {}
    for call in answers:
        if name := situation(call):
            found.setdefault(name, []).append(call)
    return {name: each for name, each in found.items() if len(each) >= MIN_ANSWERS}


def answers_without_waiting(
    service: str, situation: Callable[[Call], str], *, clause: int, help: str = FROM_MEMORY
) -> Obligation:
    """Return the obligation that a service answers at once, from values that it has already received.

    `situation` names the situation of a call; one with fewer than MIN_ANSWERS answers is not judged.
    """

    def never_waits(run: Transcript) -> str | None:
        judged = enough_answers(calls(service)(run), situation)
        for name, each in judged.items():
            require_fastest(each, FROM_MEMORY_TIME, expected=f"answers from memory, {name}", help=help)
        return ", ".join(sorted(judged)) or None

    never_waits.__doc__ = "The callback answers from memory and never waits"
    return obligation(clause, of=whole_run)(never_waits)
