"""`course grade --watch` grades submissions as they arrive, until Ctrl-C. A function replaces the arenas."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

EXERCISE = "battery_service"
# Points by a word in the source; "slow" is being graded until the test writes a file, and the stop is heeded.
JUDGE = """
import sys, time
from pathlib import Path
from autograder.classroom.batch import job
from autograder.engine.stop import Stopped
from autograder.engine.verdict import CheckVerdict, Grade

folder = Path(sys.argv.pop())

def by_word(submission, exercise, options, watcher, *, stop, **_):
    (source,) = submission.sources.values()
    (folder / f"in_work_{len(list(folder.glob('in_work_*')))}").write_text(source)
    while "slow" in source and not (folder / "go").exists():
        if stop.is_set():
            raise Stopped
        time.sleep(0.02)
    earned = [check.points if "right" in source else 0 for check in exercise.checks]
    verdicts = [
        CheckVerdict(check.id, check.title, "passed" if points else "failed", points, check.points)
        for check, points in zip(exercise.checks, earned)
    ]
    return Grade(exercise.name, submission.student, options.isolation.label, verdicts, seed=options.seed)

job.grade = by_word
from course_cli.app import main
main(sys.argv[1:])
"""


@contextmanager
def watching(folder: Path, *options: str) -> Iterator[subprocess.Popen[str]]:
    (folder / "submitted").mkdir(exist_ok=True)
    command = [
        sys.executable,
        "-c",
        JUDGE,
        "grade",
        "--watch",
        folder / "submitted",
        "--out",
        folder / "graded",
    ]
    with subprocess.Popen(
        [*command, "--jobs", "2", *options, folder],
        env={**os.environ, "COURSE_ISOLATION": "none", "COLUMNS": "200"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        try:
            assert process.stdout
            for line in process.stdout:
                if line.startswith("watching"):
                    break
            yield process
        finally:
            process.kill()


def ctrl_c(process: subprocess.Popen[str]) -> tuple[int, str]:
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=60)
    return process.returncode, said


def until(process: subprocess.Popen[str], happened: Callable[[], Any]) -> None:
    """Wait for an event while the watcher runs, for at most two minutes."""
    end = time.monotonic() + 120.0
    while not happened():
        assert process.poll() is None, process.communicate()[0]
        assert time.monotonic() < end
        time.sleep(0.05)  # between two polls


def hand_in(folder: Path, student: str, text: str) -> None:
    (folder / "submitted" / student).mkdir(exist_ok=True)
    (folder / "submitted" / student / f"{EXERCISE}.py").write_text(text)


def in_work(folder: Path) -> list[str]:
    return sorted(path.read_text() for path in folder.glob("in_work_*"))


def record(folder: Path) -> dict[str, Any]:
    return json.loads((folder / "graded/batch.json").read_text())


def scores(folder: Path) -> dict[str, float]:
    """The scores by student, from grades.json, as soon as all pages exist, too."""
    path = folder / "graded/grades.json"
    grades = json.loads(path.read_text()) if path.exists() else []
    return (
        {
            grade["student"]: grade["score"] / grade["max_score"]
            for grade in grades
            if grade["student"] in (folder / "graded/class.html").read_text()
            and (folder / f"graded/feedback/{grade['student']}/{EXERCISE}/{EXERCISE}.html").exists()
        }
        if (folder / "graded/class.html").exists()
        else {}
    )


def test_the_latest_submission_counts_and_a_second_run_resumes(tmp_path: Path) -> None:
    with watching(tmp_path) as watcher:
        hand_in(tmp_path, "anna", "slow and wrong")
        until(watcher, lambda: in_work(tmp_path))
        hand_in(tmp_path, "anna", "right")  # while the first is being graded
        hand_in(tmp_path, "bert", "right, too")
        until(watcher, lambda: scores(tmp_path) == {"bert": 1.0})
        (tmp_path / "go").touch()
        until(watcher, lambda: scores(tmp_path) == {"anna": 1.0, "bert": 1.0})
        assert record(tmp_path)["state"] == "running"
        refused = subprocess.run(
            [*map(str, watcher.args[:6]), "--out", tmp_path / "another", tmp_path],  # type: ignore[index]
            capture_output=True,
            text=True,
        )
        assert refused.returncode == 1
        assert "another `course grade --watch`" in refused.stdout
        status, said = ctrl_c(watcher)
    assert status == 0, said
    assert "2 graded" in said
    first = record(tmp_path)
    assert first["state"] == "ended"
    assert in_work(tmp_path) == ["right", "right, too", "slow and wrong"]
    assert (tmp_path / f"graded/sources/{EXERCISE}/anna/{EXERCISE}.py").read_text() == "right"

    with watching(tmp_path) as watcher:
        hand_in(tmp_path, "carl", "right as well")
        until(watcher, lambda: len(scores(tmp_path)) == 3)
        status, said = ctrl_c(watcher)
    assert status == 0, said
    assert " ".join(said.split()).count("(the same program was graded before)") == 2
    assert len(in_work(tmp_path)) == 4
    assert record(tmp_path)["seed"] == first["seed"]


def test_ctrl_c_ends_running_gradings_and_names_submissions_without_a_grade(tmp_path: Path) -> None:
    with watching(tmp_path, "--exercise", EXERCISE) as watcher:
        hand_in(tmp_path, "anna", "slow")
        until(watcher, lambda: in_work(tmp_path))
        status, said = ctrl_c(watcher)
    assert status == 1
    assert "0 graded, 1 not graded yet" in said
    assert "Traceback" not in said
    assert (record(tmp_path)["state"], record(tmp_path)["submissions"]) == ("interrupted", [])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--watch", "absent"], "is not a folder"),
        (["here", "--watch", "here"], "one folder"),
        ([], "one folder"),
        (["--watch", "here", "--shard", "1/2"], "give only one"),
    ],
)
def test_a_folder_that_cannot_be_watched_is_an_unusable_argument(
    tmp_path: Path, arguments: list[str], words: str
) -> None:
    (tmp_path / "here").mkdir()
    ran = subprocess.run(
        [Path(sys.executable).with_name("course"), "grade", *arguments],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert ran.returncode == 2, ran.stdout + ran.stderr
    assert words in " ".join(ran.stdout.split())
