"""The cells of chapter 5 show what its text says."""

from __future__ import annotations

import re

import pytest
from execution import Executed, in_order, on_paper
from gap_trials import GapTrials, Trial

CHAPTER = "05_executors"
LONG, SHORT = 2.8, 1.0  # s: a heartbeat that waits for look_around, and one that doesn't


def gap_in(text: str) -> float:
    found = re.search(r"longest gap between two heartbeats ([\d.]+) s", text)
    assert found, text
    return float(found[1])


@pytest.mark.parametrize("cell", ["one-run", "threads-run", "m3-run"])
def test_a_sleep_stops_the_heartbeat_on_one_thread_in_one_group_and_in_a_coroutine(
    chapter: Executed, cell: str
) -> None:
    assert "looked left and right" in chapter.text(cell)
    assert gap_in(chapter.text(cell)) > LONG


def test_a_coroutine_gives_its_thread_back_at_the_await_and_goes_on_after_it(chapter: Executed) -> None:
    said = ["the dish is in the oven", "the cook is free", "the dish is out", "nothing is left to do"]
    assert chapter.text("m3-by-hand").splitlines() == said


@pytest.mark.parametrize("cell", ["groups-run", "await-run"])
def test_groups_or_an_await_keep_it_punctual(chapter: Executed, cell: str) -> None:
    assert "looked left and right" in chapter.text(cell)
    assert gap_in(chapter.text(cell)) < SHORT


def test_the_robot_stops_while_the_only_thread_sleeps_and_walks_on_with_two_groups(chapter: Executed) -> None:
    for cell, starts in (("one-run", 2), ("groups-run", 1)):
        words = re.search(r'alt="([^"]+)"', chapter.html(cell))
        assert words
        assert words[1].count("→ WALKING") == starts, words[1]


def test_the_drawn_threads_are_those_of_the_run(chapter: Executed) -> None:
    one = on_paper(chapter, "one-draw")
    assert re.search(r"MainThread: beat \d+ times; look_around from [\d.]+ s to [\d.]+ s\.", one)
    assert "ThreadPoolExecutor" not in one
    assert re.search(r"Longest time from one beat to the next: 3\.\d\d s", one)
    assert re.search(r"Longest time from one beat to the next: 3\.\d\d s", on_paper(chapter, "threads-run"))
    groups = chapter.html("groups-draw")
    assert re.search(r"ThreadPoolExecutor-\d_\d: (beat.*; )?look_around from", groups)
    assert re.search(r"Longest time from one beat to the next: 0\.\d\d s", groups)
    awaited = on_paper(chapter, "await-run")
    assert in_order(
        awaited, "MainThread: beat", "look_around from", "awaiting, on no thread: look_around from"
    )


@pytest.mark.parametrize(
    ("cell", "at_the_gates"),
    [
        ("one-draw", "waits: default group: look_around is in, 0 of 1 threads free."),
        ("threads-run", "waits: default group: look_around is in, 3 of 4 threads free."),
        ("await-run", "may run: its own group: free, 1 of 1 threads free."),
    ],
)
def test_the_gates_say_where_the_heartbeat_is_while_the_robot_looks_around(
    chapter: Executed, cell: str, at_the_gates: str
) -> None:
    drawn = on_paper(chapter, cell)
    assert f"beat, if it is due, {at_the_gates}" in drawn
    assert "moment, s: " in drawn


def test_the_command_line_measures_the_same_gap(chapter: Executed) -> None:
    printed = chapter.text("one-hz")
    assert max(float(longest) for longest in re.findall(r"max: ([\d.]+)s", printed)) > LONG
    assert "looked left and right" in printed


def test_asyncio_has_no_event_loop_here(chapter: Executed) -> None:
    assert in_order(
        chapter.text("m3-asyncio"),
        "no answer",
        "ended with exit status 1",
        "RuntimeError: no running event loop",
    )


def test_a_call_in_a_callback_deadlocks_on_one_thread_and_on_four(chapter: Executed) -> None:
    assert in_order(chapter.text("m4-run"), "1 thread(s): no answer", "4 thread(s): no answer")
    assert re.search(r"on_request from [\d.]+ s on, without an end", chapter.html("m4-run"))


def test_the_report_survives_its_partner(chapter: Executed) -> None:
    assert in_order(
        chapter.text("report-run"),
        *("alone:", "success=False", "together:", "success=True, message='I am at x"),
        *("killed:", "success=False", "restarted:"),
    )


def test_a_rate_that_nobody_spins_beats_once(chapter: Executed) -> None:
    duration, unspun, spun = chapter.text("m5-run").splitlines()
    assert duration == "about 15 s"
    assert unspun == "unspun: beats at the start 1, in the next three seconds 0"
    assert int(spun.rpartition(" ")[2]) >= 20


def test_under_a_paused_simulation_a_sleep_lies_and_a_timer_waits(chapter: Executed) -> None:
    assert in_order(
        chapter.text("m18-run"),
        *("Boolean value is: True", "paused", "looked left and right", "running", "has moved by 0.0 rad"),
    )


def test_the_clock_itself_waits_for_a_coroutine_in_the_default_group(chapter: Executed) -> None:
    assert in_order(
        chapter.text("m18-fix"),
        *("awaiting.py, paused: no answer", "awaiting.py, five seconds later: look_around has ended: False"),
        *(
            "on_sim_time.py, paused: no answer",
            "on_sim_time.py, five seconds later: look_around has ended: True",
        ),
    )
    moved = re.findall(r"moved by ([\d.]+) rad", chapter.text("m18-fix"))
    assert all(float(angle) > 0.4 for angle in moved)
    assert len(moved) == 2


def test_spinning_by_hand_beside_a_task_that_awaits_serves_nothing(chapter: Executed) -> None:
    before, shrinks, constant = (
        int(count) for count in re.findall(r": (\d+) messages", chapter.text("spin-run"))
    )
    assert before > 40
    assert shrinks == 0
    assert constant > 40


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)
