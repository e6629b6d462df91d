"""The root cause of missing evidence, if the submission is that cause."""

from __future__ import annotations

from dataclasses import dataclass

from autograder.authoring.diagnosis.blocked_callback import remedy_for_no_answer
from autograder.authoring.diagnosis.exit_diagnosis import (
    GROWS,
    LEAKS,
    end_in_words,
    ended_by_itself,
    remedy_for_a_limit,
    remedy_for_the_end,
)
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

# Processor-seconds that a program may use to start, and in each second of the arena's clock. This is several times what
# a correct program needs, on a busy machine as on an idle one: a program that uses more has caused delays itself.
STARTUP_CPU_TIME, ALLOWED_LOAD = 2.0, 0.3
ONE_INTERPRETER = 1.4  # processors that one Python and the middleware's threads can keep busy for a while


@dataclass(frozen=True)
class Cause:
    """A cause in words that follow “because”, what to do about it, when it happened (s), and the lesson."""

    words: str
    help: str
    at: float
    see: str = ""


def why_it_went_no_further(run: Record) -> Cause | None:
    """Return why the scenario went no further: the student's program ended, or did not answer."""
    return _killed(run) or _exited(run) or _unanswered(run)


def why_the_robot_was_held_up(run: Record) -> Cause | None:
    """Return how the submission overloaded the robot: by messages over a limit, memory or processor time."""
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
        f"your program and the processes that it started used too much memory: at {overfull.t:.1f} s the whole arena "
        f"held {overfull.memory_mib:.0f} MiB; its limit is {overfull.limit_mib} MiB"
    )
    return Cause(words, GROWS, overfull.t, LEAKS)


def _exited(run: Record) -> Cause | None:
    exited = ended_by_itself(run)
    if exited is None:
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
        "goal": f"the goal “{given_up.id}” was neither accepted nor rejected",
        "cancel": "the cancel request had no answer",
        "result": f"the goal “{given_up.id}” had no result",
        "end": "the program was still running",
    }[given_up.what]
    remedy = remedy_for_no_answer(run)
    return Cause(f"{what} after {given_up.waited:.1f} s", remedy.help, given_up.t, remedy.see)


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
        "Publish on the robot's topics only what the task asks for, from a timer and not in an endless loop.",
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
    """Return how much processor time the submission used, if that was too much; else ''."""
    usage = run.first(ev.NodeUsage)
    if usage is None:
        return ""
    allowed = STARTUP_CPU_TIME + ALLOWED_LOAD * usage.in_time
    subject = "your program, with the processes that it started,"
    if usage.cpu_in_time > allowed:
        return (
            f"{subject} used more than {allowed:.1f} processor-seconds in {usage.in_time:.1f} s: "
            f"{usage.cpu_in_time:.1f}"
        )
    allowed = max(ONE_INTERPRETER, ALLOWED_LOAD * run.scale)
    if usage.burst > allowed:
        return f"{subject} kept more than {allowed:.1f} processors busy at once: {usage.burst:.1f}"
    return ""
