"""Films the seconds around a failed check, for the table of a self-check in a notebook."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import Exercise
from autograder.engine.judging import failed_scenarios
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.recording.recorder import Recorder
from autograder.recording.replay.film import film
from autograder.recording.replay.recording import Posture, Span, recordings_in, span_of
from ros_runtime.workarounds.gl_backend import NoOpenGLError

LEAST_MOTION = 0.05  # m or rad; a standing robot sways by less
MOST_FILMS = 3  # of one self-check; each takes about 2 s and 0.7 MB of the notebook


class FailureFilms:
    """Films the seconds around the first failures of a self-check of an exercise."""

    def __init__(self, exercise: Exercise, grade: Grade) -> None:
        self._exercise = exercise
        self._grade = grade
        self._filmed: list[tuple[CheckVerdict, Transcript, Span]] = []

    def of(self, verdict: CheckVerdict, transcripts: Sequence[Transcript]) -> tuple[str, bytes]:
        """Film a failure; return the film in words, and as animated WebP.

        There are only words if the film cannot be drawn, or if an earlier film shows the same seconds. There is nothing
        at all if the failure has no time, if nothing moved then, and after MOST_FILMS films.

        `transcripts` are those that the check was judged on, one for each of its scenarios.
        """
        check = next(check for check in self._exercise.checks if check.id == verdict.id)
        failed = failed_scenarios(check, transcripts)
        if verdict.robot_time is None or not (check.obligations or len(failed) == 1):
            return "", b""  # without obligations a check judges all its scenarios together: any may be meant
        run = transcripts[check.on.index(failed[0])]
        for earlier, filmed, span in self._filmed:
            if run is filmed and span.start <= verdict.robot_time <= span.end:
                return f"These seconds are in the film of “{earlier.title}”.", b""
        if len(self._filmed) == MOST_FILMS:
            return "", b""
        alone = replace(self._exercise, checks=[replace(check, on=(failed[0],))])
        recorder = Recorder(alone, for_students=True)
        recorder.add(verdict, [run])
        (recording,) = recordings_in(recorder.files(replace(self._grade, checks=[verdict])))
        span = span_of(recording, verdict.id, None)
        shown = [posture for posture in recording.postures if span.start <= posture.t <= span.end]
        if not _moves(shown):
            return "", b""
        self._filmed.append((verdict, run, span))
        webp = io.BytesIO()
        try:
            film(recording, span, webp)
        except NoOpenGLError as error:
            return f"No film: {error}", b""
        return _words(shown, verdict), webp.getvalue()


def _moves(shown: Sequence[Posture]) -> bool:
    """Return whether the robot moves in these postures."""
    places = [[*posture.base[:3], *posture.joints] for posture in shown]
    return len(places) > 1 and bool(np.ptp(np.array(places), axis=0).max() > LEAST_MOTION)


def _words(shown: Sequence[Posture], verdict: CheckVerdict) -> str:
    """Return the alternative text of a film of these postures."""
    first, last = shown[0], shown[-1]
    return (
        f"The robot from {first.t:.1f} to {last.t:.1f} s; the check fails at {verdict.robot_time:.1f} s. It moves "
        f"{math.dist(first.base[:2], last.base[:2]):.2f} m. Its pelvis is {first.base[2]:.2f} m above the floor at the "
        f"beginning and {last.base[2]:.2f} m at the end."
    )
