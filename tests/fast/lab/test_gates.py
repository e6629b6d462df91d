"""The two conditions for a callback at a moment of a run: a free callback group and a free thread."""

from __future__ import annotations

import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import lab

DEFAULT = {"beat": "default group", "look_around": "default group"}
OWN = {"beat": "its own group", "look_around": "default group"}
RUN = """
100.00 T_0 beat begins
100.01 T_0 beat ends
101.00 T_0 look_around begins
104.00 T_0 look_around ends
104.90 T_1 beat begins
104.91 T_1 beat ends
"""
AWAIT = """
100.00 T_0 look_around begins
100.01 T_0 look_around awaits
103.00 T_0 look_around resumes
103.01 T_0 look_around ends
103.50 T_0 beat begins
103.51 T_0 beat ends
"""


def node(log: str, ended: float = 105.0) -> Any:
    return SimpleNamespace(
        log=lambda: log, file=Path("scout.py"), history=lambda: SimpleNamespace(ended=ended)
    )


def said(log: str, groups: dict[str, str], threads: int, moment: float | None = None) -> str:
    picture, slider = lab.draw_gates(node(log), groups, threads=threads).children
    if moment is not None:
        slider.value = min((value for _, value in slider.options), key=lambda value: abs(value - moment))
    return str(picture.value)


@pytest.mark.parametrize(
    ("groups", "threads", "expected"),
    [
        (DEFAULT, 1, "waits: default group: look_around is in, 0 of 1 threads free."),
        (DEFAULT, 4, "waits: default group: look_around is in, 3 of 4 threads free."),
        (OWN, 1, "waits: its own group: free, 0 of 1 threads free."),
        (OWN, 4, "may run: its own group: free, 3 of 4 threads free."),
    ],
)
def test_the_gates_show_the_longest_callback_by_default(
    groups: dict[str, str], threads: int, expected: str
) -> None:
    shown = said(RUN, groups, threads)
    assert f"beat, if it is due, {expected}" in shown
    assert "look_around runs and keeps the default group." in shown


def test_the_slider_goes_through_the_run() -> None:
    shown = said(RUN, DEFAULT, 1, moment=4.5)
    assert "beat, if it is due, may run: default group: free, 1 of 1 threads free." in shown
    assert "look_around, if it is due, may run" in shown


def test_a_callback_that_awaits_keeps_its_group_and_no_thread() -> None:
    shown = said(AWAIT, OWN, 1)
    assert "look_around awaits, on no thread and keeps the default group." in shown
    assert "beat, if it is due, may run" in shown
    assert "beat, if it is due, waits: default group: look_around is in" in said(AWAIT, DEFAULT, 1)


def test_a_callback_without_an_end_keeps_both_until_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time, "monotonic", lambda: 200.0)
    assert "0 of 1 threads free" in said("100.0 T_0 look_around begins\n", DEFAULT, 1)


def test_a_callback_without_a_known_group_is_named() -> None:
    with pytest.raises(lab.LabError, match=r"scout\.py: `groups` has no group for look_around"):
        lab.draw_gates(node(RUN), {"beat": "default group"}, threads=1)
    with pytest.raises(lab.LabError, match="the node has printed no lines about its callbacks"):
        lab.draw_gates(node("nothing"), DEFAULT, threads=1)
