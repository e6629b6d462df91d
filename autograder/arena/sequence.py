"""A scenario as a sequence of steps from a vocabulary, written down by an author or drawn from a seed.

ASK_TWICE = Scenario("in_order", {"steps": [["ask", 1], ["set_battery", 0.35], ["ask", 1]]})
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from autograder.arena.offering import Offering
from autograder.arena.units import UNITS

Steps = Sequence[Sequence[Any]]  # each is [verb, *arguments]
NO_WORDS: Mapping[str, str] = {}


def carry_out(
    stage: Offering,
    steps: Steps,
    vocabulary: Mapping[str, Callable[..., object]],
    words: Mapping[str, str] = NO_WORDS,
) -> None:
    """Carry out the steps in order and mark the end of each; stop at a step that returns False (no answer).

    Students read the steps of a failure. `words` has a format for verbs that they would not understand:
    `{"ask": "{number} × get_status"}`.
    """
    stage.plan(
        [in_words(verb, vocabulary[verb], arguments, words.get(verb, "")) for verb, *arguments in steps]
    )
    for number, (verb, *arguments) in enumerate(steps, start=1):
        if vocabulary[verb](*arguments) is False:
            return
        stage.mark(f"step {number}")


def in_words(verb: str, act: Callable[..., object], arguments: Sequence[Any], form: str = "") -> str:
    """Return a step to read, with the names and units of the parameters of `act`: 'go “walk” x 0.55 m y 0.2 m'.

    Where a step has one argument, it is shown without its name if its unit says what it is: 'wait 1.5 s'. A `form`
    replaces these words; it names the parameters: '{number} × get_status'.
    """
    signature = inspect.signature(act)
    bound = signature.bind(*arguments)
    if form:
        bound.apply_defaults()
        return form.format(**{name: _shown(value) for name, value in bound.arguments.items()})
    given = bound.arguments
    units = {name: UNITS.get(str(signature.parameters[name].annotation), "") for name in given}
    is_clear = len(arguments) == 1 and any(units.values())
    words = []
    for name, value in given.items():
        shown = f"{_shown(value)} {units[name]}".rstrip()
        words.append(f"“{value}”" if name == "name" else shown if is_clear else f"{_plain(name)} {shown}")
    return f"{_plain(verb)} {' '.join(words)}".rstrip()


def _plain(name: str) -> str:
    return name.replace("_", " ")


def _shown(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, Mapping):
        return ", ".join(f"{name} {_shown(each)}" for name, each in value.items())
    if isinstance(value, list | tuple):
        return f"({', '.join(map(_shown, value))})"
    return str(value)
