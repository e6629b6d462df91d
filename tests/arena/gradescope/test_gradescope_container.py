"""The package grades in a container without namespaces, and a submission cannot write the score."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from autograder.classroom.archives.gradescope_package import TOP, write_package
from autograder.engine.exercise import exercises_folder, load_exercise

ROOT = Path(__file__).resolve().parents[3]
CONTAINER = Path(__file__).with_name("in_container.py")
CORRECT = (exercises_folder() / "patterns/known/correct/lines_of_text.py").read_text()
NODE = "battery_service"

# The environment of this clone, because setup.sh would take minutes to make one; everything else is from the package.
LAUNCHER = f"""#!/bin/sh
export PYTHONPATH=/mnt/autograder/source/{TOP}
exec {sys.executable} -c 'from course_cli.app import main; main()' "$@"
"""
FORGED = json.dumps({"score": 1000, "output": "forged"})
HOSTILE = """
import ctypes, json, os, signal, subprocess, sys, time
ROOT = "/mnt/autograder"
def attempt(name, action):
    try:
        print(name, "WORKED", action())
    except Exception as error:
        print(name, "refused:", type(error).__name__)
def write():
    with open(f"{ROOT}/results/results.json", "w") as file:
        file.write(FORGED)
def rename():
    with open("/tmp/forged.json", "w") as file:
        file.write(FORGED)
    os.rename("/tmp/forged.json", f"{ROOT}/results/results.json")
def kill():
    for entry in os.listdir("/proc"):
        if entry.isdigit() and int(entry) != os.getpid() and os.stat(f"/proc/{entry}").st_uid == 0:
            os.kill(int(entry), signal.SIGTERM)
def again_root():
    os.setuid(0)
def trace():
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.ptrace(16, os.getppid(), 0, 0) != 0:
        raise OSError(ctypes.get_errno())
def memory():
    open(f"/proc/{os.getppid()}/mem", "r+b").close()
def namespaces():
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.unshare(0x10000000) != 0:
        raise OSError(ctypes.get_errno())
def listing(folder):
    return lambda: os.listdir(f"{ROOT}/{folder}")
for name, action in {
    "write": write, "rename": rename, "kill": kill, "again_root": again_root, "trace": trace, "memory": memory,
    "listing": listing("results"), "upload": listing("submission"), "checks": listing("source/TOP/checks"),
    "submitters": lambda: open(f"{ROOT}/submission_metadata.json").read(),
    "su": lambda: subprocess.check_output(["su", "-c", "id"], stdin=subprocess.DEVNULL), "namespaces": namespaces,
}.items():
    attempt(name, action)
print("user is root", os.getuid() == 0, flush=True)
if os.fork() == 0:
    ctypes.CDLL(None).prctl(15, b"MARK", 0, 0, 0)  # its name
    os.setsid()
    for _ in range(600):
        try:
            write()
        except OSError:
            pass
        time.sleep(0.05)
    os._exit(0)
""".replace("FORGED", repr(FORGED)).replace("TOP", TOP)
MARK = f"daemon{os.getpid()}"


def can_unshare() -> bool:
    if os.geteuid() != 0:
        return False
    return subprocess.run(["unshare", "--mount", "true"], capture_output=True).returncode == 0


pytestmark = pytest.mark.skipif(
    not can_unshare(), reason="only root with mount namespaces can play a container"
)


@dataclass
class Run:
    """The outcome of run_autograder."""

    status: int
    results: Any
    said: str
    folder: Path


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package of all exercises; the name of the submitted file selects the exercise."""
    path = tmp_path_factory.mktemp("package") / "autograder.zip"
    write_package(ROOT, path)
    return path


@pytest.fixture
def autograder(tmp_path: Path, package: Path) -> Path:
    """The folder /autograder with the package unpacked as by Gradescope, and no submission."""
    folder = tmp_path / "autograder"
    with zipfile.ZipFile(package) as archive:
        archive.extractall(folder / "source")
        for entry in archive.infolist():
            (folder / "source" / entry.filename).chmod(entry.external_attr >> 16)
    (folder / "source" / TOP / "course").write_text(LAUNCHER)
    (folder / "run_autograder").write_bytes((folder / "source/run_autograder").read_bytes())
    (folder / "run_autograder").chmod(0o755)
    for name in ("submission", "results"):
        (folder / name).mkdir()
    (folder / "results").chmod(0o777)
    (folder / "submission_metadata.json").write_text('{"users": []}')
    return folder


def run(folder: Path, submission: str, exercise: str = "patterns", **variables: str) -> Run:
    (folder / f"submission/{exercise}.py").write_text(submission)
    container = ["unshare", "--mount", "--", sys.executable, str(CONTAINER), str(folder)]
    environment = {"PATH": os.environ["PATH"], "GRADESCOPE_ROOT": "/mnt/autograder", **variables}
    done = subprocess.run(
        [*container, "/mnt/autograder/run_autograder"],
        capture_output=True,
        text=True,
        env=environment,
        timeout=300,
    )
    results = folder / "results/results.json"
    return Run(
        done.returncode,
        json.loads(results.read_text()) if results.exists() else None,
        done.stdout + done.stderr,
        folder,
    )


def test_a_sound_node_gets_the_points_of_the_visible_checks(autograder: Path) -> None:
    visible = load_exercise(NODE, hidden=False)
    graded = run(autograder, (exercises_folder() / NODE / "known/correct/class_based.py").read_text(), NODE)
    assert graded.status == 0, graded.said
    assert "isolation: another-user" in graded.said
    assert graded.results["score"] == visible.max_score(), graded.results
    assert [test["name"] for test in graded.results["tests"]] == [check.title for check in visible.checks]
    assert {test["visibility"] for test in graded.results["tests"]} == {"visible"}


def test_a_program_that_attacks_gets_no_points_and_reaches_nothing(autograder: Path) -> None:
    (autograder / "results/results.json").write_text(FORGED)  # left by an earlier upload
    graded = run(autograder, HOSTILE.replace("MARK", MARK))
    assert graded.status == 0, graded.said
    assert graded.results["score"] == 0
    assert (autograder / "results/results.json").stat().st_uid == 0
    outputs = "\n".join(test["output"] for test in graded.results["tests"])
    assert "user is root False" in outputs
    assert outputs.count("refused:") >= 12
    assert "WORKED" not in outputs
    names = [_content(path) for path in Path("/proc").glob("[0-9]*/comm")]
    assert f"{MARK}\n".encode() not in names  # processes that it left behind have ended with the grading


def _content(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""


def test_an_unreadable_submission_is_the_students_failure(autograder: Path) -> None:
    graded = run(autograder, "ab\0cd")
    assert graded.status == 0, graded.said
    assert graded.results["score"] == 0
    assert "is no text: hand in the text file" in graded.results["tests"][0]["output"]


@pytest.mark.parametrize("broken", ["isolation", "checks"])
def test_a_container_that_cannot_grade_gives_no_score(autograder: Path, broken: str) -> None:
    variables = {"COURSE_ISOLATION": "none"} if broken == "isolation" else {}
    if broken == "checks":
        (autograder / "source" / TOP / "checks/patterns/checks.py").write_text(
            "raise RuntimeError('a broken image')"
        )
    (autograder / "results/results.json").write_text(FORGED)
    graded = run(autograder, CORRECT, **variables)
    assert graded.status == 1
    assert "score" not in graded.results
    assert "tests" not in graded.results
    assert "not a zero" in graded.results["output"]
