"""The root cause of a gap in the record, if the submission caused it."""

from __future__ import annotations

from dataclasses import dataclass

from autograder.authoring.diagnosis.exit_diagnosis import (
    GROWS,
    LEAKS,
    end_in_words,
    remedy_for_a_limit,
    remedy_for_the_end,
)
from autograder.authoring.diagnosis.stack_location import where_it_waited, why_nobody_serves
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

# Processor-seconds that a sound program may use to start, and in each second of the arena's clock: as many on a busy
# machine as on an idle one, and several times what it needs. One that uses more caused what comes late itself.
STARTUP_CPU_TIME, ALLOWED_LOAD = 2.0, 0.3
ONE_INTERPRETER = 1.4  # processors: what Python and the threads of the middleware can keep busy for a while

SERVES = "02_services#first-intro"
DEADLOCK = "02_services#m4-why"
_WAITS = (
    "A callback may not wait, sleep or call another service while the node has only one thread: nobody else is "
    "served meanwhile."
)
_AWAITS = (
    "No thread stood still, so a callback awaits what never comes. A node's default callback group lets in one "
    "callback at a time: give a client inside a callback a group of its own, and the await a time limit."
)


@dataclass(frozen=True)
class Cause:
    """A reason that follows “because” in a sentence, what to do about it, when it happened (s), and the lesson."""

    words: str
    help: str
    at: float
    see: str = ""


def about_waiting(run: Record) -> tuple[str, str]:
    """Return what to do about a program that gives no answer, by the line on which it stood, and the lesson."""
    if place := where_it_waited(run):
        return f"It stood in {place}. {_WAITS}", DEADLOCK
    if idle := why_nobody_serves(run):
        return idle, SERVES
    return _WAITS if run.first(ev.NodeStack) is None else _AWAITS, DEADLOCK


def why_it_went_no_further(run: Record) -> Cause | None:
    """Return why the scenario went no further: the student's program ended, or did not answer."""
    return _killed(run) or _exited(run) or _unanswered(run)


def why_the_robot_was_held_up(run: Record) -> Cause | None:
    """Return how the submission held up the robot: by messages it had to refuse, busy processors, or all the memory."""
    return _refused(run) or _overfull(run) or _busy(run)


def _killed(run: Record) -> Cause | None:
    killed = run.first(ev.NodeKilled)
    if killed is None:
        return None
    remedy = remedy_for_a_limit(killed)
    words = f"the node had been ended at {killed.t:.1f} s: {killed.reason}"
    return Cause(words, remedy.help, killed.t, remedy.see)


def _overfull(run: Record) -> Cause | None:
    overfull = run.first(ev.ArenaOverfull)
    if overfull is None:
        return None
    words = (
        f"your program, with all it started, filled the arena: {overfull.memory_mib:.0f} MiB of memory at "
        f"{overfull.t:.1f} s; {overfull.limit_mib} MiB are there for everybody"
    )
    return Cause(words, GROWS, overfull.t, LEAKS)


def _exited(run: Record) -> Cause | None:
    exited, signalled = run.first(ev.NodeExited), run.first(ev.NodeSignalled)
    if exited is None or (signalled is not None and signalled.t <= exited.t):
        return None
    remedy = remedy_for_the_end(run, exited)
    words = f"the node had ended at {exited.t:.1f} s, {end_in_words(run, exited)}"
    return Cause(words, remedy.help, exited.t, remedy.see)


def _unanswered(run: Record) -> Cause | None:
    given_up = run.first(ev.Unanswered)
    if given_up is None:
        return None
    what = {
        "call": f"{_service_of(run, given_up.id)} had given no answer",
        "goal": f"the goal “{given_up.id}” had got neither yes nor no",
        "cancel": "the cancel request had got no answer",
        "result": f"the goal “{given_up.id}” had got no result",
        "end": "the program still ran",
    }[given_up.what]
    help, see = about_waiting(run)
    return Cause(f"{what} after {given_up.waited:.1f} s", help, given_up.t, see)


def _service_of(run: Record, call: str) -> str:
    return next((asked.service for asked in run.all(ev.ServiceCalled) if asked.call == call), "a service")


def _refused(run: Record) -> Cause | None:
    refusals = run.all(ev.RobotRefused)
    if not refusals:
        return None
    topic = max(refusals, key=lambda refusal: refusal.bytes).topic
    last = [refusal for refusal in refusals if refusal.topic == topic][-1]
    return Cause(
        f"your node sent {last.count:,} {topic} messages of up to {_size(last.bytes)}; {last.reason}",
        "Publish on the robot's topics only what the task asks for, at the rate of a timer, not in a loop without end.",
        last.t,
    )


def _size(count: int) -> str:
    return f"{count / 1e6:.1f} MB" if count >= 1e5 else f"{count / 1e3:.1f} kB"


def _busy(run: Record) -> Cause | None:
    words = _load_in_words(run)
    if not words:
        return None
    return Cause(
        words,
        "Look for a loop without a pause, and for programs or threads started again and again: spin() waits by itself "
        "until there is something to do.",
        run.all(ev.NodeUsage)[0].t,
    )


def _load_in_words(run: Record) -> str:
    """Return what the submission used of the processors if that is too much, else nothing."""
    usage = run.first(ev.NodeUsage)
    if usage is None:
        return ""
    allowed = STARTUP_CPU_TIME + ALLOWED_LOAD * usage.in_time
    subject = "your program, with all it started,"
    if usage.cpu_in_time > allowed:
        return (
            f"{subject} used more than {allowed:.1f} processor-seconds in {usage.in_time:.1f} s: "
            f"{usage.cpu_in_time:.1f}"
        )
    allowed = max(ONE_INTERPRETER, ALLOWED_LOAD * run.scale)
    if usage.burst > allowed:
        return f"{subject} kept more than {allowed:.1f} processors busy at once: {usage.burst:.1f}"
    return ""
