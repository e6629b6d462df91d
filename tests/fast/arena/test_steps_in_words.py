"""The steps of a scenario in words, as a student reads them in a failure."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from autograder.arena import events as ev
from autograder.arena.sequence import in_words
from autograder.arena.units import Metres, Radians, Seconds
from autograder.authoring import sequence
from autograder.authoring.evidence.transcript import Transcript


def go(name: str, x: Metres, yaw: Radians, limit: float = 0.0) -> None: ...


def wait(duration: Seconds) -> None: ...


@pytest.mark.parametrize(
    ("verb", "act", "arguments", "words"),
    [
        ("go", go, ["walk", 0.55, -2.6], "go “walk” x 0.55 m yaw -2.6 rad"),
        ("go", go, ["walk", 1.0, 0.0, 0.2], "go “walk” x 1 m yaw 0 rad limit 0.2"),
        ("wait", wait, [1.5], "wait 1.5 s"),
        ("cut_power", lambda: None, [], "cut power"),
        ("push", lambda *impulse: None, [0.0, 60.0], "push impulse (0, 60)"),
        ("set", lambda lengths: None, [{"upper": 0.3}], "set lengths upper 0.3"),
    ],
)
def test_arguments_have_the_names_and_units_of_their_parameters(
    verb: str, act: Callable[..., None], arguments: list[Any], words: str
) -> None:
    assert in_words(verb, act, arguments) == words


def test_a_form_replaces_verb_and_names() -> None:
    def ask(number: int, on: bool = True) -> None: ...

    assert in_words("ask", ask, [3], "{number} × get_status {on}") == "3 × get_status True"


def test_a_failure_has_the_words_of_the_arena() -> None:
    steps = [["go", "walk", 1.0], ["wait", 1.5]]
    planned = ev.StepsPlanned(t=0.0, words=["go “walk” x 1 m", "wait 1.5 s"])
    run = Transcript.from_events("in_order", {"steps": steps}, [planned])
    assert sequence.in_words(run, steps[:1]) == ["go “walk” x 1 m"]
    assert sequence.in_words(Transcript.from_events("in_order", {"steps": steps}, []), steps)[1] == "wait 1.5"
