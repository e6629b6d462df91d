"""Scenarios as data: several fetches in sequence, with the scripts of their children and the events during them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from autograder.authoring import Scenario

Steps = list[list[Any]]
Script = Mapping[str, Any]
LONG_WALK_TIME = 4.0  # s, the duration of a walk during which an event happens
LONG_STAGE_TIME = 2.6  # s, the duration of a stage during which an event happens
AFTERWARDS = 1.5  # s after a result, in which the server must not send a goal
CHARGED = 0.8  # percentage in battery_state, from 0 to 1


@dataclass(frozen=True)
class Part:
    """A part of a scenario: its steps, and the scripts for the walks and picks that a correct server sends in it."""

    steps: Steps
    walks: Sequence[Script] = ()
    picks: Sequence[Script] = ()


def fetch(
    name: str, *events: list[Any], cup: Sequence[Any] = (), children: Sequence[Script] = ({}, {}, {}, {})
) -> Part:
    """Return a fetch during which events happen: steps that are carried out after it is accepted.

    `cup` has the fields of its goal (object_id, x, y, z, force, yaw), `children` the scripts of its walks and picks.
    """
    steps = [["go", name, *cup], *events, ["end", name], ["wait", AFTERWARDS]]
    return Part(steps, children[::2], children[1::2])


def drop(name: str, level: float, last: int, at: str = "", *events: list[Any], **script: Any) -> Part:
    """Return a fetch during which the battery falls to a level when the child of step `last` is under way.

    `at` is the stage of that child at which this happens, `script` its script. `events` follow at once. When fetch has
    ended, the battery is charged.
    """
    part = fetch(name, _reach(last, at), ["battery", level], *events, children=_children(last, at, script))
    home: list[Script] = [{}] if last < 3 else []  # the walk of a robot that gives up
    return Part([*part.steps, ["battery", CHARGED], ["wait", 1.0]], [*part.walks, *home], part.picks)


def cancel(name: str, last: int, at: str = "", **script: Any) -> Part:
    """Return a fetch that is canceled when the child of step `last` is under way, or at the stage `at`."""
    return fetch(name, _reach(last, at), ["cancel", name], children=_children(last, at, script))


def preempt(old: str, new: str, last: int, at: str = "", cup: Sequence[Any] = (), **script: Any) -> Part:
    """Return a fetch that a newer one preempts when the child of step `last` is under way, or at the stage `at`."""
    first = fetch(old, _reach(last, at), children=_children(last, at, script))
    second = fetch(new, ["end", old], cup=cup)
    return Part(
        [*first.steps[:2], *second.steps], [*first.walks, *second.walks], [*first.picks, *second.picks]
    )


def levels(*percentages: float) -> Steps:
    """Return steps that publish these levels of the battery."""
    return [step for each in percentages for step in (["wait", 0.4], ["battery", each])]


def in_order(*parts: Part, battery: float | None = CHARGED) -> dict[str, Any]:
    """Return the inputs of a scenario made of these parts."""
    walks, picks = ([each for part in parts for each in getattr(part, name)] for name in ("walks", "picks"))
    steps = [step for part in parts for step in part.steps]
    return {"battery": battery, "walks": walks or [{}], "picks": picks or [{}], "steps": steps}


def scenario(*parts: Part, battery: float | None = CHARGED, **options: Any) -> Scenario:
    """Return the scenario whose steps are these parts; `options` are the other fields of `Scenario`."""
    return Scenario("in_order", in_order(*parts, battery=battery), robot=None, **options)


def _children(last: int, at: str, script: Script) -> list[Script]:
    """Return scripts of which the last has a walk or a stage that is long enough for an event during it."""
    return [
        *({} for _ in range(last - 1)),
        {"stages": {at: LONG_STAGE_TIME}, **script} if at else {"takes": LONG_WALK_TIME, **script},
    ]


def _reach(last: int, at: str) -> list[Any]:
    return ["reach", last, at] if at else ["reach", last]
