"""The mutation operators: each finds where it applies in a program, and makes the mistake that its sentence names."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from autograder.classroom.audit.generated.mistakes import conditions, fields, memory, timing
from autograder.classroom.audit.generated.mistakes.fields import NUMBERS, with_wrong_numbers
from autograder.classroom.audit.generated.mistakes.rewrites import rewrites, rewritten
from autograder.classroom.audit.generated.program import Edits, Program

Operator = Callable[[Program], Iterator[Edits]]

# Each operator's name, with its sentence and function. If two operators make the same program, the mutant belongs to
# the first one, so the general operators come last.
OPERATORS: dict[str, tuple[str, Operator]] = {
    **{name: (words, partial(rewritten, instead=each)) for name, (words, each) in rewrites().items()},
    **{name: (words, partial(with_wrong_numbers, changes=each)) for name, (words, each) in NUMBERS.items()},
    **{
        operator.__name__: ((operator.__doc__ or "").rstrip("."), operator)
        for operator in (
            fields.copies_some_fields,
            fields.answers_with_the_goal,
            memory.forgets_a_reset,
            memory.keeps_the_first_message,
            memory.forgets_what_is_old,
            timing.waits_in_a_callback,
            timing.halves_or_doubles,
            timing.restarts_the_deadline,
            conditions.loses_the_exit_status,
            conditions.drops_the_finally,
            conditions.takes_another_constant,
            fields.leaves_a_field_out,
            conditions.drops_a_guard,
        )
    },
}
