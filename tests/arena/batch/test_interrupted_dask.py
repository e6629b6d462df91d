"""Ctrl-C in a batch on a Dask cluster: the command ends, the cluster runs on, and no job of the batch stays queued."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

from distributed import Client, LocalCluster

# A worker whose jobs report their start and run until the test lets them end.
PRELOADED = """
import time
from pathlib import Path
from autograder.classroom.batch import job

FOLDER = Path({folder!r})

def held(submission, *rest, **options):
    (FOLDER / f"{{submission.student}}.begun").touch()
    while not (FOLDER / "go").exists():
        time.sleep(0.02)
    raise OSError("the test is over")

job.grade = held
"""
STUDENTS = [f"student{number}" for number in range(6)]


def test_ctrl_c_removes_queued_jobs_and_leaves_the_cluster_running(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setenv("COURSE_ISOLATION", "none")
    for student in STUDENTS:
        (tmp_path / "submitted" / student).mkdir(parents=True)
        (tmp_path / "submitted" / student / "battery_service.py").write_text(f"name = {student!r}\n")
    preload = tmp_path / "held.py"
    preload.write_text(PRELOADED.format(folder=str(tmp_path)))
    with (
        LocalCluster(
            n_workers=1, threads_per_worker=1, dashboard_address=None, preload=[str(preload)]
        ) as local,
        Client(local.scheduler_address, set_as_default=False) as client,
    ):
        command = ["grade", tmp_path / "submitted", "--out", tmp_path / "graded"]
        with subprocess.Popen(
            [Path(sys.executable).with_name("course"), *command, "--dask", local.scheduler_address],
            env=os.environ,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        ) as grader:
            while not list(tmp_path.glob("*.begun")):
                assert grader.poll() is None, grader.communicate()[0]
            grader.send_signal(signal.SIGINT)
            said, _ = grader.communicate(timeout=60)  # the running job has not ended yet
        (tmp_path / "go").touch()
        assert grader.returncode == 1, said
        assert "Add --resume" in said
        assert "Traceback" not in said
        assert json.loads((tmp_path / "graded/batch.json").read_text())["state"] == "interrupted"
        assert client.submit(sum, [1, 2]).result(timeout=60) == 3
        assert len(list(tmp_path.glob("*.begun"))) < len(STUDENTS)
