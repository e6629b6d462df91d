"""Which functions of a program ROS calls, and for what."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.classroom.audit.generated.program import Named, Program, last_name

# What takes callbacks: the kind of each, by its place or keyword among the arguments.
_TAKERS: dict[str, dict[int | str | None, str]] = {
    "create_subscription": {2: "subscription", "callback": "subscription"},
    "create_service": {2: "service", "callback": "service"},
    "create_timer": {1: "timer", "callback": "timer"},
    "send_goal_async": {1: "feedback", "feedback_callback": "feedback"},
    "ActionServer": {"goal_callback": "goal", "cancel_callback": "cancel"},
}


def callbacks(program: Program, *kinds: str) -> Iterator[Named]:
    """Yield the functions that are called for one of these kinds of events, each once, without lambdas."""
    named = [one for one in program.every(ast.stmt) if isinstance(one, Named)]
    found: dict[Named, None] = {}
    for call in program.every(ast.Call):
        given = [*enumerate(call.args), *((word.arg, word.value) for word in call.keywords)]
        taken = _TAKERS.get(last_name(call), {})
        around = set(program.above(call))
        for name in [last_name(value) for place, value in given if taken.get(place) in kinds]:
            of_one_name = [one for one in named if one.name == name]
            of_its_class = [one for one in of_one_name if program.parent(one) in around]
            found |= dict.fromkeys((of_its_class or of_one_name)[:1])
    yield from found
