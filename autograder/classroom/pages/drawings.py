"""Drawings of the runs of failed checks, stored on disk while a class is graded."""

from __future__ import annotations

import hashlib
import json
import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.pages.plots import motion_svgs
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.sequence import transcript_svg

Sources = Mapping[str, str]

FOLDER = Path("cache/drawings")
DRAWN = ("failed", "error")
MAX_DRAWN_RUNS = 3  # of one check

# SVG drawings of the runs that a check was judged on, by the check's id
DrawnRuns = Mapping[str, Sequence[str]]


@dataclass(frozen=True)
class Drawings:
    """The drawings in a batch's output folder, keyed by program and verdict, so that cached grades have them, too."""

    batch: Path

    def keep_all(self, grade: Grade, sources: Sources, drawn: DrawnRuns) -> None:
        """Store the drawings of all checks of a grade; `drawn` has them by the check's id."""
        for verdict in grade.checks:
            if verdict.id in drawn:
                self.keep(grade.exercise, sources, verdict, drawn[verdict.id])

    def of(self, grade: Grade, sources: Sources | None) -> dict[str, list[str]]:
        """Return the stored drawings (SVG) of a grade, by the id of each check that has drawings."""
        if sources is None:
            return {}
        paths = {
            verdict.id: self._path(grade.exercise, sources, verdict)
            for verdict in grade.checks
            if verdict.status in DRAWN
        }
        return {check: svgs for check, path in paths.items() if path.exists() and (svgs := _read(path))}

    def keep(self, exercise: str, sources: Sources, verdict: CheckVerdict, drawn: Sequence[str]) -> None:
        """Store the drawings (SVG) of one verdict."""
        write_atomically(self._path(exercise, sources, verdict), json.dumps(drawn))

    def _path(self, exercise: str, sources: Sources, verdict: CheckVerdict) -> Path:
        key = json.dumps([dict(sources), asdict(verdict)], sort_keys=True)
        return self.batch / FOLDER / exercise / f"{hashlib.sha256(key.encode()).hexdigest()}.json"


def _read(path: Path) -> list[str]:
    """Read stored drawings; [] if the file is damaged, because no grade depends on drawings."""
    try:
        svgs = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return []
    is_valid = isinstance(svgs, list) and all(isinstance(svg, str) for svg in svgs)
    return svgs if is_valid else []


def drawing_into(
    drawn: dict[str, Sequence[str]],
) -> Callable[[CheckVerdict, Sequence[Transcript]], None]:
    """Return an `on_evidence` callback for `grade` that draws the transcripts of failed verdicts into `drawn`."""

    def add(verdict: CheckVerdict, transcripts: Sequence[Transcript]) -> None:
        if verdict.status not in DRAWN:
            return
        try:
            drawn[verdict.id] = draw(transcripts)
        except Exception:  # a failed drawing must not affect the grade
            logging.getLogger(__name__).exception("no drawing of %s", verdict.id)

    return add


def draw(transcripts: Sequence[Transcript]) -> list[str]:
    """Draw runs as SVG: the sequence of messages and, if the robot moved, its motion.

    Raises:
        ValueError: a run has no events.
    """
    drawn: list[str] = []
    for transcript in transcripts[:MAX_DRAWN_RUNS]:
        title = transcript.scenario.replace("_", " ")
        drawn += [transcript_svg(transcript, title), *motion_svgs(transcript, title)]
    return drawn
