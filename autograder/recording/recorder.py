"""Collects the verdicts and transcripts of one submission, and makes a recording of each scenario."""

from __future__ import annotations

import json
import logging
from collections import Counter
from collections.abc import Sequence

from autograder.authoring.checks import Scenario
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import Exercise
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.recording.entry import FORMAT, Entry
from autograder.recording.interface_messages import InterfaceMessages
from autograder.recording.kept import Recordings
from autograder.recording.log_messages import RecordedVerdict, log_messages, verdict_messages
from autograder.recording.mcap_file import mcap_file
from autograder.recording.robot_messages import robot_messages, scene_and_robot_of

MAX_SUBMISSION_BYTES = 64 * 2**20  # of all recordings of a submission


class Recorder:
    """Receives each verdict with its transcripts, and makes one recording of each scenario.

    If a scenario ran more than once, a run on which a point was lost is recorded, else the last judged run.

    Args:
        exercise: the exercise, with the checks that are run.
        for_students: include only scenarios and verdicts of visible checks.
    """

    def __init__(self, exercise: Exercise, *, for_students: bool) -> None:
        self._exercise = exercise
        self._checks = {check.id: check for check in exercise.checks if not (for_students and check.hidden)}
        self._shows_hidden = any(check.hidden for check in self._checks.values())
        self._runs: dict[Scenario, Transcript] = {}
        self._lost: set[Scenario] = set()  # scenarios in whose recorded run a point was lost
        self._judged_on: dict[str, Sequence[Transcript]] = {}

    def add(self, verdict: CheckVerdict, transcripts: Sequence[Transcript]) -> None:
        """Add a verdict and its transcripts, one for each scenario of the check."""
        check = self._checks.get(verdict.id)
        if check is None:
            return
        self._judged_on[verdict.id] = transcripts
        is_lost = verdict.status != "passed"
        for scenario, transcript in zip(check.on, transcripts, strict=True):
            if is_lost or scenario not in self._lost:
                self._runs[scenario] = transcript
            if is_lost:
                self._lost.add(scenario)

    @property
    def runs(self) -> Sequence[Transcript]:
        """The runs to record, one of each scenario that was judged."""
        return list(self._runs.values())

    def files(self, grade: Grade) -> Recordings:
        """Make the recordings up to the size limit, first those in which a point was lost.

        A recording that cannot be made is left out and the error is logged, so that the grade is not affected.
        """
        names = self._names()
        made: dict[str, bytes] = {}
        size = 0
        for scenario in sorted(self._runs, key=lambda scenario: scenario not in self._lost):
            name = f"{names[scenario]}.mcap"
            try:
                content = self._recording(scenario, grade)
            except Exception:
                logging.getLogger(__name__).exception("no recording %s", name)
                continue
            if size + len(content) > MAX_SUBMISSION_BYTES:
                logging.getLogger(__name__).warning(
                    "no recording %s: the recordings of this submission are too large", name
                )
                continue
            size += len(content)
            made[name] = content
        return made

    def _recording(self, scenario: Scenario, grade: Grade) -> bytes:
        run = self._runs[scenario]
        judged = [
            self._judged(verdict, scenario, run)
            for verdict in grade.checks
            if verdict.id in self._checks and scenario in self._checks[verdict.id].on
        ]
        return mcap_file(self._entries(run, scenario, judged), self._metadata(run, scenario, grade))

    def _metadata(self, run: Transcript, scenario: Scenario, grade: Grade) -> dict[str, str]:
        """Return the metadata that `course replay` and other viewers show."""
        scene, robot = scene_and_robot_of(run)
        return {
            "format": FORMAT,
            "exercise": grade.exercise,
            "student": grade.student,
            "scenario": scenario.name,
            "namespace": scenario.namespace,  # of the robot and the student's node
            "params": json.dumps(run.params),
            "seed": str(grade.seed),
            "scale": f"{run.scale:g}",  # how much faster than real time the arena's clock ran
            "end": f"{run.end:.6f}",  # s on the arena's clock
            "scene": scene,  # "" without a robot, like the next
            "robot": robot,
            "shows_hidden_checks": "yes" if self._shows_hidden else "no",
        }

    def _judged(self, verdict: CheckVerdict, scenario: Scenario, run: Transcript) -> RecordedVerdict:
        runs = self._judged_on.get(verdict.id, [run])
        others = [other.name for other in self._checks[verdict.id].on if other is not scenario]
        return RecordedVerdict(
            verdict, from_another_run=not any(run is one for one in runs), other_scenarios=others
        )

    def _entries(self, run: Transcript, scenario: Scenario, judged: Sequence[RecordedVerdict]) -> list[Entry]:
        interfaces = InterfaceMessages(scenario.namespace)
        return [
            *robot_messages(run, scenario.namespace),
            *(entry for event in run.events for entry in interfaces.of(event)),
            *log_messages(run, self._exercise.name),
            *verdict_messages(judged, run.end),
        ]

    def _names(self) -> dict[Scenario, str]:
        """Return a name for each scenario of the exercise; repeated names get a number: walk, walk-2."""
        seen: Counter[str] = Counter()
        names: dict[Scenario, str] = {}
        for scenario in (scenario for check in self._exercise.checks for scenario in check.on):
            if scenario not in names:
                seen[scenario.name] += 1
                number = seen[scenario.name]
                names[scenario] = scenario.name if number == 1 else f"{scenario.name}-{number}"
        return names
