"""Obligations that fit every service: one line each in an exercise's model.

answers_in_time = answered_within(2.0, "get_battery_status", clause=4)
never_waits = answers_from_memory("get_battery_status", lambda call: "known" if … else "unknown", clause=4)
"""

from __future__ import annotations

from collections.abc import Callable

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.failure import expect
from autograder.authoring.obligation import Obligation, calls, obligation, whole_run
from autograder.authoring.transcript import Transcript

# s: an answer from memory takes some ms of real time, which the arena's clock makes 10 times as many; of several
# answers the fastest shows whether a callback waits, for a busy machine does not delay them all.
FROM_MEMORY_TIME = 0.6
ENOUGH_ANSWERS = 3  # of which the fastest is looked at
FROM_MEMORY = "Answer from memory: the callback must not sleep or wait for the next message."


def answered_within(timeout: float, service: str, *, clause: int, help: str = FROM_MEMORY) -> Obligation:
    """Make the obligation that every request is answered within `timeout` (s), however many come together."""

    def answers_in_time(call: Call) -> str:
        expect(
            call.answered.t - call.sent.t <= timeout,
            expected=f"an answer within {timeout:g} s",
            observed=f"it took {call.latency:.1f} s",
            help=help,
            at=call.answered.t,
        )
        asked = [each.t for each in call.run.all(ev.ServiceCalled) if each.service == service]
        together = sum(abs(t - call.sent.t) < 0.5 for t in asked)
        return "one at a time" if together == 1 else "several together"

    answers_in_time.__doc__ = f"Every request is answered within {timeout:g} s, also when many come together"
    return obligation(clause, of=calls(service))(answers_in_time)


def answers_from_memory(
    service: str, situation: Callable[[Call], str], *, clause: int, help: str = FROM_MEMORY
) -> Obligation:
    """Make the obligation that the callback never waits, in any `situation` that a run has enough requests in."""

    def never_waits(run: Transcript) -> str | None:
        by_situation: dict[str, list[Call]] = {}
        for call in calls(service)(run):
            by_situation.setdefault(situation(call), []).append(call)
        judged = {name: each for name, each in by_situation.items() if len(each) >= ENOUGH_ANSWERS}
        for name, each in judged.items():
            fastest = min(each, key=lambda call: call.answered.t - call.sent.t)
            expect(
                fastest.latency <= FROM_MEMORY_TIME,
                expected=f"answers from memory, {name}",
                observed=f"the fastest of {len(each)} took {fastest.latency:.1f} s",
                help=help,
                at=fastest.answered.t,
            )
        return ", ".join(sorted(judged)) or None

    never_waits.__doc__ = "The callback answers from memory and never waits"
    return obligation(clause, of=whole_run)(never_waits)
