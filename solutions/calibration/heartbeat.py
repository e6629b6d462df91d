"""Requires heartbeats without a gap, and says which callback delayed them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from autograder.authoring import Transcript, ev, expect, require_alive, unseen, where_it_waited

MAX_GAP = 0.3  # s without a heartbeat
JITTER = 0.06  # s of real time by which a message may be late on a busy machine
MAX_JITTER = 1.0  # s; a callback that blocks causes a gap of at least 2 s
MIN_RATE, MAX_RATE = 7.5, 13.0  # Hz
MIN_DURATION = 2.5  # s; in a shorter span no rate is measured
Times = Sequence[tuple[float, float]]  # begin and end of each span, s


def beats(run: Transcript) -> str:
    """The heartbeat goes on at 10 Hz, whatever the services do.

    It is checked from the first one to the end of the scenario or SIGINT, in short scenarios only: in 47 s a correct
    program on a busy machine had three gaps of 0.6 to 0.74 s.
    """
    require_alive(run)
    signalled = run.first(ev.NodeSignalled)
    end = signalled.t if signalled else run.end
    heard = [event.t for event in run.received("heartbeat") if event.t <= end]
    working = _at_work(run, end)
    if not working:
        raise unseen(run, "calibrate_imu was never called")
    expect(
        len(heard) > 1 and heard[0] <= working[0][0],
        expected="ten messages a second on heartbeat, from the start on",
        observed=f"{len(heard)} messages" if len(heard) < 2 else f"the first message at {heard[0]:.1f} s",
        help="In the constructor, create a publisher (std_msgs/Empty) with a relative name, and a timer of 0.1 s.",
    )
    late = [woken.late for woken in run.all(ev.WokenLate)] + [robot.lag for robot in run.ground_truth]
    late += [starved.seconds for starved in run.all(ev.Starved)]
    limit = MAX_GAP + JITTER * run.scale + min(max(late, default=0.0), MAX_JITTER)
    start, stop = max(zip(heard, [*heard[1:], end], strict=True), key=lambda pair: pair[1] - pair[0])
    during = any(since - MAX_GAP <= start <= until for since, until in working)
    expect(
        stop - start <= limit,
        expected=f"no gap of more than {MAX_GAP:g} s between two heartbeats",
        observed=f"a gap of {stop - start:.1f} s, from {start:.1f} s on"
        + (", during a request to calibrate_imu" if during else ""),
        help=_advice_on_the_gap(run, during),
        at=start,
    )
    idle = [(before, after) for (_, before), (after, _) in pairwise(working)]
    _require_rate(heard, working, "during requests to calibrate_imu")
    _require_rate(heard, idle, "between requests")
    return "whole run"


def _require_rate(beats: Sequence[float], times: Times, when: str) -> None:
    long_ones = [(start, end) for start, end in times if end - start >= MIN_DURATION]
    if not long_ones:
        return
    seconds = sum(end - start for start, end in long_ones)
    rate = sum(start <= beat < end for beat in beats for start, end in long_ones) / seconds
    expect(
        MIN_RATE <= rate <= MAX_RATE,
        expected=f"10 heartbeats a second, also {when}",
        observed=f"{rate:.1f} a second",
        help="Create one timer with a period of 0.1 s that publishes one message each time.",
        at=long_ones[0][0],
    )


def _at_work(run: Transcript, end: float) -> list[tuple[float, float]]:
    """Return the begin and end (s) of the times with a request waiting for its response, joined if they overlap."""
    answered = {event.call: event.t for event in run.all(ev.ServiceAnswered)}
    joined: list[tuple[float, float]] = []
    for event in run.all(ev.ServiceCalled):
        until = answered.get(event.call, end)
        if joined and event.t <= joined[-1][1]:
            joined[-1] = (joined[-1][0], max(joined[-1][1], until))
        else:
            joined.append((event.t, until))
    return joined


def _advice_on_the_gap(run: Transcript, during: bool) -> str:
    if not during:
        return "The heartbeat's timer must run as long as the node: create it in the constructor."
    if place := where_it_waited(run):
        return (
            f"The timer's callback could not run: another callback blocked its thread or callback group in {place}. "
            "Use await there."
        )
    if run.first(ev.NodeStack):
        return (
            "No callback blocked a thread: one awaits something that never completes, and keeps its callback group. "
            "Give the heartbeat's timer, and the client or timer that completes the await, a ReentrantCallbackGroup or "
            "groups of their own."
        )
    return (
        "The timer's callback cannot run while the callback of calibrate_imu blocks: make that async, and await "
        "futures in it."
    )
