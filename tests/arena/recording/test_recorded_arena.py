"""Recordings of real arenas contain the robot's true motion, and grades are the same with and without them."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from markupsafe import escape
from rosbags.highlevel import AnyReader

from audited.proof import enough_to_catch
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.audit.known_submission import known_submission
from autograder.engine.exercise import load_exercise
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.recording.kept import keep
from autograder.recording.recorder import Recorder
from autograder.recording.replay.recording import Recording, span_of

EXERCISE = "cancellable_walk"
KNOWN = known_submission(EXERCISE, "faulty/cuts_the_motors")  # the robot falls when it is canceled
CHECKS = enough_to_catch(KNOWN, load_exercise(EXERCISE, hidden=True))
FALLEN = 3


def graded(recorder: Recorder | None) -> tuple[Grade, list[Transcript]]:
    runs: list[Transcript] = []

    def add(verdict: CheckVerdict, transcripts: Any) -> None:
        runs.extend(transcripts)
        if recorder:
            recorder.add(verdict, transcripts)

    options = GradingOptions(recorded=recorder is not None)
    return grade(KNOWN.read(), CHECKS, options, Watcher(on_evidence=add)), runs


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Grade, Path]:
    recorder = Recorder(CHECKS, for_students=False)
    result, _ = graded(recorder)
    folder = tmp_path_factory.mktemp("recordings")
    keep(folder, recorder.files(result))
    (path,) = (path for path in folder.glob("*.mcap") if Recording.read(path).first_failed)
    return result, path


def test_the_fall_that_cost_a_point_is_in_the_file(recorded: tuple[Grade, Path]) -> None:
    result, path = recorded
    (failed,) = [check for check in result.checks if check.status == "failed"]
    assert failed.id == "stops_when_canceled"
    with AnyReader([path]) as reader:
        found: dict[str, list[Any]] = {}
        for connection, at, data in reader.messages():
            found.setdefault(connection.topic, []).append(
                (at / 1e9, reader.deserialize(data, connection.msgtype))
            )
    (error,) = [(t, line) for t, line in found["/rosout"] if line.function == failed.id]
    assert error[1].level == 40
    assert error[0] == pytest.approx(failed.robot_time, abs=1e-6)
    heights = [odom.pose.pose.position.z for _, odom in found["/robot/odom"]]
    assert max(heights[:10]) > 0.55
    assert min(heights) < 0.4
    assert any(state.mode == FALLEN for _, state in found["/robot/robot_state"])
    times = [t for t, _ in found["/robot/odom"]]
    assert len(times) / (times[-1] - times[0]) == pytest.approx(25, abs=3)
    assert {"/robot/walk_to/_action/feedback", "/robot/walk_to/_action/status"} <= set(found)


def test_a_replay_shows_the_seconds_around_it(recorded: tuple[Grade, Path]) -> None:
    recording = Recording.read(recorded[1])
    span = span_of(recording, None, 3.0)
    assert recording.first_failed
    assert recording.first_failed.check == "stops_when_canceled"
    shown = [posture.base[2] for posture in recording.postures if span.start <= posture.t <= span.end]
    assert len(shown) > 60


def test_without_a_recording_the_grade_is_the_same_and_no_posture_is_sampled(
    recorded: tuple[Grade, Path],
) -> None:
    result, runs = graded(None)
    assert [(check.id, check.status, check.points) for check in result.checks] == [
        (check.id, check.status, check.points) for check in recorded[0].checks
    ]
    assert result.score == recorded[0].score
    assert runs
    assert not any(run.postures for run in runs)


def test_check_keeps_visible_scenarios_only_and_writes_a_page_to_show(tmp_path: Path) -> None:
    source = known_submission("battery_service", "faulty/answers_from_a_cache").read().sources
    (tmp_path / "battery_service.py").write_text(source["battery_service.py"])
    ran = subprocess.run(
        [
            Path(sys.executable).with_name("course"),
            *("check", "battery_service", "battery_service.py", "--record", "--json", "verdicts.json"),
            *("--page", "page.html"),
        ],
        cwd=tmp_path,
        env={**os.environ, "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 1, ran.stdout + ran.stderr
    visible = {
        scenario.name
        for check in load_exercise("battery_service", hidden=False).checks
        for scenario in check.on
    }
    files = sorted((tmp_path / "recordings" / "battery_service").iterdir())
    assert files
    assert {path.stem.split("-")[0] for path in files} <= visible
    assert f"{len(files)} recordings in recordings/battery_service" in ran.stdout
    shown = {moment.check for path in files for moment in Recording.read(path).moments if moment.check}
    checks = json.loads((tmp_path / "verdicts.json").read_text())["checks"]
    assert shown == {check["id"] for check in checks}
    assert any(Recording.read(path).first_failed for path in files)
    assert all(Recording.read(path).about["shows_hidden_checks"] == "no" for path in files)
    page = (tmp_path / "page.html").read_text()
    assert all(escape(check["title"]) in page for check in checks)
    assert source["battery_service.py"].splitlines()[0].strip('"') in page
    assert "No robot moves in these checks" in page
    assert "<svg" in page
    assert re.search(r"page\.html: \d+ kB", ran.stdout)
