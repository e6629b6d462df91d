"""Scenarios as data: fetches one after the other, with the scripts of their children and what happens meanwhile."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from autograder.authoring import Scenario

Steps = list[list[Any]]
Script = Mapping[str, Any]
LONG_WALK_TIME = 4.0  # s of a walk in which something happens
AT_WORK = 2.6  # s of such a stage
AFTERWARDS = 1.5  # s after a result in which nothing more may be asked for
CHARGED = 0.8


@dataclass(frozen=True)
class Part:
    """A piece of a scenario: its steps, and the scripts of the walks and picks that a right server sends in it."""

    steps: Steps
    walks: Sequence[Script] = ()
    picks: Sequence[Script] = ()


def fetch(
    name: str, *events: list[Any], cup: Sequence[Any] = (), children: Sequence[Script] = ({}, {}, {}, {})
) -> Part:
    """Return a fetch during which events happen: steps that are carried out when it is accepted.

    `cup` is what its goal says (object_id, x, y, z, force, yaw), `children` are the scripts of its walks and picks.
    """
    steps = [["go", name, *cup], *events, ["end", name], ["wait", AFTERWARDS]]
    return Part(steps, children[::2], children[1::2])


def drop(name: str, level: float, last: int, at: str = "", *events: list[Any], **script: Any) -> Part:
    """Return a fetch whose battery falls to a level when the child of its last step is under way, or at a stage.

    `events` come right after, and when fetch has ended, the battery is charged. `script` is that of the child.
    """
    part = fetch(name, _reach(last, at), ["battery", level], *events, children=_children(last, at, script))
    home: list[Script] = [{}] if last < 3 else []  # the walk of a robot that gives up
    return Part([*part.steps, ["battery", CHARGED], ["wait", 1.0]], [*part.walks, *home], part.picks)


def cancel(name: str, last: int, at: str = "", **script: Any) -> Part:
    """Return a fetch that is canceled when the child of a step is under way, or at a stage."""
    return fetch(name, _reach(last, at), ["cancel", name], children=_children(last, at, script))


def preempt(old: str, new: str, last: int, at: str = "", cup: Sequence[Any] = (), **script: Any) -> Part:
    """Return a fetch that a newer one preempts when the child of a step is under way, or at a stage."""
    first = fetch(old, _reach(last, at), children=_children(last, at, script))
    second = fetch(new, ["end", old], cup=cup)
    return Part(
        [*first.steps[:2], *second.steps], [*first.walks, *second.walks], [*first.picks, *second.picks]
    )


def levels(*percentages: float) -> Steps:
    """Return the steps in which the battery has these levels."""
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
    """Return scripts of which the last one has a walk or a stage that is long enough for something to happen in it."""
    return [
        *({} for _ in range(last - 1)),
        {"stages": {at: AT_WORK}, **script} if at else {"takes": LONG_WALK_TIME, **script},
    ]


def _reach(last: int, at: str) -> list[Any]:
    return ["reach", last, at] if at else ["reach", last]
