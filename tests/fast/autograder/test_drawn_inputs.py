"""The inputs that scenarios draw, over many seeds: they can be executed, have unique names, and are in bounds.

A seed is any number, and each batch has a new one: what fails once in a thousand draws fails a class. 100,000 seeds
take half an hour: DRAWN_SEEDS=100000 .venv/bin/pytest tests/fast/autograder/test_drawn_inputs.py -n 4
"""

from __future__ import annotations

import json
import math
import os
import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

import pytest

from autograder.arena.agent import scenarios_in
from autograder.authoring.checks import Scenario
from autograder.engine.exercise import exercise_names, load_exercise
from ros_runtime.recorded_client.conversation import Conversation

SEEDS = int(os.environ.get("DRAWN_SEEDS", "25"))
APART = 0.08  # m between a cup's position and its target, so that the two can be distinguished
NUMBER = re.compile(r"-?\d+(\.\d+)?")  # an argument of a program
CHARGES, SECONDS = (0.0, 1.0), (0.0, 70.0)
BOUNDS = {
    "set_battery": CHARGES,
    "wait": SECONDS,
    "walk_for": SECONDS,
    "come_near": (0.1, 0.3),
    "height": (0.45, 0.6),
}


class StandIn(int):
    """Stands for a stage: it accepts any attribute and call, and names requests by the arena's own rule."""

    names: Conversation
    kind = name = ""

    def __getattr__(self, attribute: str) -> StandIn:
        if attribute.startswith("__"):
            raise AttributeError(attribute)
        return self._other(
            attribute if attribute in ("service", "action", "listen") else self.kind, self.name
        )

    def __call__(self, *arguments: Any, as_: str = "", **_: Any) -> StandIn:
        self.names.name(self.kind, self.name, as_)
        return self._other(
            self.kind, arguments[0] if arguments and isinstance(arguments[0], str) else self.name
        )

    def __iter__(self) -> Iterator[Any]:
        return iter(())

    def __enter__(self) -> StandIn:
        return self

    def __exit__(self, *_: object) -> None:
        """Leave nothing."""

    def _other(self, kind: str, name: str) -> StandIn:
        other = type(self)(1)
        other.names, other.kind, other.name = self.names, kind, name
        return other


def drawn() -> Iterator[Any]:
    """Yield each exercise's scenarios that draw their inputs, with the place of the module that carries them out."""
    for exercise in exercise_names():
        loaded = load_exercise(exercise, hidden=True)
        scenarios = dict.fromkeys(one for check in loaded.checks for one in check.on if one.is_drawn)
        for number, scenario in enumerate(scenarios):
            yield pytest.param(loaded.scenario_file, scenario, id=f"{exercise}-{scenario.name}-{number}")


def numbers(inputs: Any, of: str = "") -> Iterator[tuple[str, float]]:
    """Yield each number with the verb of its step, or its own name."""
    if isinstance(inputs, dict):
        for name, value in inputs.items():
            yield from numbers(value, name)
    elif isinstance(inputs, list):
        verb = inputs[0] if inputs and isinstance(inputs[0], str) else of
        for value in inputs:
            yield from numbers(value, verb)
    elif isinstance(inputs, int | float):
        yield of, inputs


def parts(inputs: dict[str, Any], values: list[tuple[str, float]]) -> set[tuple[str, int]]:
    """Return steps and other inputs, each with how often it is there; of a number only whether another equals it.

    Calls and goals are named by words of the steps, and by numbers that are drawn: two of those may be equal.
    """
    often = Counter(number for _, number in values)

    def words(value: Any) -> str:
        if isinstance(value, list):
            return f"[{','.join(map(words, value))}]"
        if isinstance(value, dict):
            return words([[name, each] for name, each in value.items()])
        if isinstance(value, str):
            return "a number" if NUMBER.fullmatch(value) else value
        return str(often[value] > 1)

    each = ([name, one] for name, of in inputs.items() for one in (of if isinstance(of, list) else [of]))
    return set(Counter(map(words, each)).items())


@pytest.mark.parametrize(("scenario_file", "scenario"), list(drawn()))
def test_any_seed_draws_what_can_be_carried_out(scenario_file: Any, scenario: Scenario) -> None:
    carry_out = getattr(scenarios_in(str(scenario_file)), scenario.name)
    carried_out: set[tuple[str, int]] = set()
    for seed in range(SEEDS):
        inputs = json.loads(json.dumps(scenario.draw(seed)))  # as the arena gets them
        values = list(numbers(inputs))
        if not (new := parts(inputs, values)) <= carried_out:
            carried_out |= new
            stage = StandIn(1)
            stage.names = Conversation(log=stage)  # type: ignore[arg-type]
            try:
                carry_out(stage, **inputs)
            except Exception as error:
                raise AssertionError(f"seed {seed} draws {inputs}") from error
        for of, number in values:
            least, most = BOUNDS.get(of, (-math.inf, math.inf))
            assert math.isnan(number) or least <= number <= most, f"seed {seed}: {of} {number}"
        for one, other in [(inputs.get("cup"), inputs.get("place")), inputs.get("places", (None, None))]:
            assert not one or not other or math.dist(one, other) >= APART, f"seed {seed}: {one} {other}"


def test_a_name_that_is_given_twice_is_found() -> None:
    stage = StandIn(1)
    stage.names = Conversation(log=stage)  # type: ignore[arg-type]
    battery = stage.service("get_battery_status")
    battery.call(as_="level 0.183")
    stage.action("walk_to").send(as_="level 0.183")
    with pytest.raises(ValueError, match="already a service named"):
        battery.call(as_="level 0.183")
