"""nbgrader's formgrader, started in the folder that `course grade` has written, shows the grades."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator

import pytest
from made_up_grades import FAILED, grade_of
from nbgrader.api import Gradebook

from autograder.classroom.nbgrader_bridge.gradebook import Entry

TOKEN = "let-me-in"
PATIENCE = 90.0  # s for Jupyter to start on a busy machine


@pytest.fixture
def formgrader(gradebook, course) -> Iterator[Callable[[str], str]]:
    """A Jupyter server in a course folder with one grade; returns the text of formgrader's pages."""
    gradebook.enter(
        Entry(grade_of("anna", ends_cleanly=FAILED), {"battery_service.py": "print('a program')\n"})
    )
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = [f"--ServerApp.port={port}", "--ServerApp.port_retries=0", f"--IdentityProvider.token={TOKEN}"]
    server = subprocess.Popen(
        [sys.executable, "-m", "jupyter", "lab", "--no-browser", "--allow-root", *options],
        cwd=course,
        env={**os.environ, "JUPYTER_CONFIG_DIR": str(course / "jupyter"), "HOME": str(course)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )

    def page(path: str) -> str:
        request = urllib.request.Request(
            f"http://127.0.0.1:{port}/formgrader{path}", headers={"Authorization": f"token {TOKEN}"}
        )
        with urllib.request.urlopen(request, timeout=PATIENCE) as response:
            return response.read().decode()

    try:
        _wait_for(server, page)
        yield page
    finally:
        server.terminate()
        server.communicate(timeout=30)


def _wait_for(server: subprocess.Popen, page: Callable[[str], str]) -> None:
    deadline = time.monotonic() + PATIENCE
    while True:
        try:
            page("/api/assignments")
            return
        except urllib.error.HTTPError:
            raise
        except OSError:
            if server.poll() is not None or time.monotonic() > deadline:
                server.kill()
                pytest.fail(f"Jupyter did not come up:\n{server.communicate()[0].decode()[-3000:]}")
            time.sleep(0.2)


def test_formgrader_shows_a_students_score_and_work(formgrader, course):
    assert '"name": "battery_service"' in formgrader("/api/assignments")
    grade = grade_of("anna", ends_cleanly=FAILED)
    assert f'"score": {float(grade.score)}' in formgrader("/api/submissions/battery_service")
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        submission = db.find_submission_notebook("battery_service", "battery_service", "anna").id
    page = formgrader(f"/submissions/{submission}")
    assert "Observed: what was" in page
    assert "a program" in page
