"""The checks: recorded runs in which what the program sent is replaced by generated values."""

from __future__ import annotations

import json
import random
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from hypothesis import strategies as st

from audited.recorded import Case, cases
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import exercise_names
from autograder.engine.judging import judge
from autograder.engine.verdict import LENGTH_NOTE, LONGEST
from autograder.report.sequence import transcript_svg
from fuzz.arena.wild_messages import wild_message
from fuzz.fuzzer import Fuzzer
from fuzz.strategies import ODD_TEXTS

MESSAGES: Mapping[type, str] = {  # where a student's message is in an event, by its type
    ev.ServiceAnswered: "response",
    ev.FeedbackReceived: "feedback",
    ev.ResultReceived: "result",
    ev.MessageReceived: "message",
    ev.RequestReceived: "message",
    ev.GoalReceived: "message",
}


def require_verdicts(drawn: tuple[str, int, bool]) -> None:
    """Require a verdict of each check, and not full marks where everything that was sent is replaced."""
    exercise, seed, all_of_it = drawn
    chance = random.Random(seed)
    submission = chance.choice(sorted({case.submission for case in _cases(exercise)}))
    wilder: dict[int, Transcript] = {}
    passed = []
    for case in _cases(exercise):
        if case.submission != submission:
            continue
        runs = [wilder.setdefault(id(run), _wild(run, chance, all_of_it)) for run in case.transcripts]
        verdict = judge(case.check, runs)
        assert verdict.status in ("passed", "failed", "error"), case
        assert "Traceback" not in verdict.help, f"{case}: {verdict.help}"
        for name, most in LONGEST.items():
            assert len(getattr(verdict, name)) <= most + LENGTH_NOTE
        json.dumps(verdict.to_json() if hasattr(verdict, "to_json") else vars(verdict))
        assert verdict.points == (case.check.points if verdict.status == "passed" else 0)
        passed.append(verdict.status == "passed")
    assert not (all_of_it and all(passed)), f"{exercise} {submission}: full marks for generated messages"
    for run in list(wilder.values())[:1]:
        transcript_svg(run, "drawn")


@cache
def _cases(exercise: str) -> Sequence[Case]:
    return cases(exercise)


def _wild(run: Transcript, chance: random.Random, all_of_it: bool) -> Transcript:
    """Return a run with what the student's program sent replaced, all or some of it."""
    events = [
        _replaced(event, chance) if all_of_it or chance.random() < 0.3 else event for event in run.events
    ]
    return replace(run, events=events)


def _replaced(event: Any, chance: random.Random) -> Any:
    if name := MESSAGES.get(type(event)):
        return replace(event, **{name: wild_message(type(getattr(event, name)), chance)})
    if isinstance(event, ev.NodeOutput):
        return replace(event, text=chance.choice(ODD_TEXTS))
    if isinstance(event, ev.StatusSeen):
        return replace(event, status=chance.randint(-128, 127))
    if isinstance(event, ev.NodeExited):
        return replace(event, returncode=chance.choice((0, 1, -9, 255)))
    if isinstance(event, ev.CancelAnswered):
        return replace(event, return_code=chance.randint(-128, 127), canceling=chance.choices(ODD_TEXTS, k=3))
    if isinstance(event, ev.GoalAnswered):
        return replace(event, accepted=chance.random() < 0.5)
    return event


_drawn = st.tuples(st.sampled_from(exercise_names()), st.integers(0, 2**32 - 1), st.booleans())

FUZZERS = (Fuzzer("answers-judged", "answers", _drawn, require_verdicts, weight=0.3),)
