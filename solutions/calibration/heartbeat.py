"""Requires heartbeats without a gap, and says which callback held them up."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.failure import expect
from autograder.authoring.missing import unseen
from autograder.authoring.readiness import require_alive
from autograder.authoring.standing import where_it_stood
from autograder.authoring.transcript import Transcript

GAP = 0.3  # s without a heartbeat
JITTER = 0.06  # s of real time by which a message may be late on a busy machine
MOST_JITTER = 1.0  # s; a callback that blocks costs 2 s at least
SLOWEST, FASTEST = 7.5, 13.0  # Hz, heartbeats


def require_heartbeat(run: Transcript, call: Call, meanwhile: str) -> None:
    """Require heartbeats at 10 Hz without a gap, from the first to the end of the scenario; `call` falls into it."""
    beats = [event.t for event in run.heard("heartbeat")]
    require_alive(run)
    if call.answer is None and not run.given_up("call", call.name):
        raise unseen(run, f"calibrate_imu was not at work to the end of “{call.name}”")
    expect(
        len(beats) > 1 and beats[0] <= call.sent.t,
        expected="messages on heartbeat, ten a second, from the start on",
        observed=f"{len(beats)} messages" if len(beats) < 2 else f"the first one at {beats[0]:.1f} s",
        help="Make a publisher (std_msgs/Empty) and a timer of 0.1 s in the constructor, with relative names.",
    )
    late = [woken.late for woken in run.all(ev.WokenLate)] + [robot.lag for robot in run.ground_truth]
    late += [starved.seconds for starved in run.all(ev.Starved)]
    limit = GAP + JITTER * run.scale + min(max(late, default=0.0), MOST_JITTER)
    ends = [*beats[1:], run.end]
    start, end = max(zip(beats, ends, strict=True), key=lambda pair: pair[1] - pair[0])
    during = any(since - GAP <= start <= until for since, until in _at_work(run))
    expect(
        end - start <= limit,
        expected=f"no gap of more than {GAP:g} s between two heartbeats",
        observed=f"{end - start:.1f} s without one, from {start:.1f} s on{f', {meanwhile}' if during else ''}",
        help=_advice_on_the_gap(run, during),
        at=start,
    )
    rate = (len(beats) - 1) / (beats[-1] - beats[0])
    expect(
        SLOWEST <= rate <= FASTEST,
        expected="10 heartbeats a second",
        observed=f"{rate:.1f} a second",
        help="Make one timer with a period of 0.1 s that publishes one message each time.",
    )


def _at_work(run: Transcript) -> list[tuple[float, float]]:
    """Return from when to when (s) each request to the student's node waited for its answer."""
    answered = {event.call: event.t for event in run.all(ev.ServiceAnswered)}
    return [(event.t, answered.get(event.call, run.end)) for event in run.all(ev.ServiceCalled)]


def _advice_on_the_gap(run: Transcript, during: bool) -> str:
    if not during:
        return "The timer of the heartbeat must go on as long as the node runs: make it in the constructor."
    if place := where_it_stood(run):
        return f"The timer got no turn: a callback stood in {place}, and held its thread or its group. Await there."
    return (
        "The timer gets no turn while the callback of calibrate_imu waits. Either await in it (async def, and futures "
        "that an answer or a timer completes), or give the timer a callback group and a thread of its own."
    )
