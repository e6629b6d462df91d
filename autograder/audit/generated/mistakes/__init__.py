"""The operators: each finds the places of a program where it applies, and makes the mistake its docstring names."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from autograder.audit.generated.mistakes import conditions, endings, fields, graph, memory, numbers, timing
from autograder.audit.generated.program import Mistake, Program

Operator = Callable[[Program], Iterator[Mistake]]

# Where two make the same program it is the first one's, so what is particular comes before what is general.
OPERATORS: dict[str, Operator] = {
    operator.__name__: operator
    for operator in (
        fields.copies_some_fields,
        fields.collapses_duplicates,
        fields.answers_with_the_goal,
        numbers.rounds_a_number,
        numbers.takes_another_unit,
        numbers.leaves_an_angle_unwrapped,
        numbers.limits_each_axis,
        numbers.counts_from_the_start,
        conditions.tests_for_another_state,
        conditions.checks_the_first_only,
        conditions.lets_nan_through,
        memory.forgets_a_reset,
        memory.keeps_the_first_message,
        memory.forgets_what_is_old,
        timing.waits_in_a_callback,
        timing.halves_or_doubles,
        timing.restarts_the_deadline,
        endings.misses_a_cancel,
        endings.swaps_the_status,
        endings.takes_the_code_for_the_status,
        endings.loses_the_exit_status,
        endings.prints_to_the_other_stream,
        endings.drops_the_finally,
        graph.makes_a_name_absolute,
        graph.takes_the_usual_qos,
        fields.leaves_a_field_out,
        conditions.drops_a_condition,
        conditions.drops_a_guard,
        numbers.turns_the_sign,
    )
}
