"""Requires heartbeats without a gap, and says which callback held them up."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from autograder.authoring import Transcript, ev, expect, require_alive, unseen, where_it_waited

GAP = 0.3  # s without a heartbeat
JITTER = 0.06  # s of real time by which a message may be late on a busy machine
MOST_JITTER = 1.0  # s; a callback that blocks costs 2 s at least
SLOWEST, FASTEST = 7.5, 13.0  # Hz, heartbeats
LONG_ENOUGH = 2.5  # s at work, or without a request, for a rate of its own
Times = Sequence[tuple[float, float]]  # from when to when, s


def beats(run: Transcript) -> str:
    """The heartbeat goes on at 10 Hz, whatever the services do.

    From the first one to the end of the scenario or Ctrl-C. Only for short scenarios: in 47 s a sound program on a busy
    machine had three gaps of 0.6 to 0.74 s.
    """
    require_alive(run)
    signalled = run.first(ev.NodeSignalled)
    end = signalled.t if signalled else run.end
    heard = [event.t for event in run.received("heartbeat") if event.t <= end]
    working = _at_work(run, end)
    if not working:
        raise unseen(run, "calibrate_imu was never asked")
    expect(
        len(heard) > 1 and heard[0] <= working[0][0],
        expected="messages on heartbeat, ten a second, from the start on",
        observed=f"{len(heard)} messages" if len(heard) < 2 else f"the first one at {heard[0]:.1f} s",
        help="Make a publisher (std_msgs/Empty) and a timer of 0.1 s in the constructor, with relative names.",
    )
    late = [woken.late for woken in run.all(ev.WokenLate)] + [robot.lag for robot in run.ground_truth]
    late += [starved.seconds for starved in run.all(ev.Starved)]
    limit = GAP + JITTER * run.scale + min(max(late, default=0.0), MOST_JITTER)
    start, stop = max(zip(heard, [*heard[1:], end], strict=True), key=lambda pair: pair[1] - pair[0])
    during = any(since - GAP <= start <= until for since, until in working)
    expect(
        stop - start <= limit,
        expected=f"no gap of more than {GAP:g} s between two heartbeats",
        observed=f"{stop - start:.1f} s without one, from {start:.1f} s on"
        + (", while calibrate_imu was at work" if during else ""),
        help=_advice_on_the_gap(run, during),
        at=start,
    )
    idle = [(before, after) for (_, before), (after, _) in pairwise(working)]
    _require_rate(heard, working, "while calibrate_imu is at work")
    _require_rate(heard, idle, "between requests")
    return "whole run"


def _require_rate(beats: Sequence[float], times: Times, when: str) -> None:
    long_ones = [(start, end) for start, end in times if end - start >= LONG_ENOUGH]
    if not long_ones:
        return
    seconds = sum(end - start for start, end in long_ones)
    rate = sum(start <= beat < end for beat in beats for start, end in long_ones) / seconds
    expect(
        SLOWEST <= rate <= FASTEST,
        expected=f"10 heartbeats a second, also {when}",
        observed=f"{rate:.1f} a second",
        help="Make one timer with a period of 0.1 s that publishes one message each time.",
        at=long_ones[0][0],
    )


def _at_work(run: Transcript, end: float) -> list[tuple[float, float]]:
    """Return from when to when (s) requests waited for their answers, joined where they overlap."""
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
        return "The timer of the heartbeat must go on as long as the node runs: make it in the constructor."
    if place := where_it_waited(run):
        return f"The timer got no turn: a callback stood in {place}, and held its thread or its group. Await there."
    return "The timer gets no turn while the callback of calibrate_imu waits: await in it (async def, and futures)."
