"""Exercises of another repository are checked, graded, audited and released with this engine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import nbformat
import pytest
from course_command import course
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from ros_runtime.project import PROJECT

# Without what this environment adds for its own processes.
PLAIN = {name: os.environ[name] for name in ("HOME", "LANG", "TMPDIR") if name in os.environ} | {
    "PATH": "/usr/bin:/bin"
}
SCENARIOS = """
def count(stage, to):
    stage.start_program([str(to)])
    stage.wait_for_end()
"""
CHECKS = '''
from autograder.authoring import check, program
from .judging import require_numbers

TO_THREE = program("count", {"to": 3}, timed=False)


@check(points=1, on=TO_THREE)
def counts_to_three(run):
    """It prints 1, 2, 3"""
    require_numbers(run)
'''
HIDDEN = '''
from autograder.authoring import check, program
from .checks import counts_to_three
from .judging import require_numbers

FURTHER = program("count", lambda random: {"to": random.randint(5, 9)}, timed=False)


@check(points=2, on=FURTHER, needs=counts_to_three)
def counts_to_any_number(run):
    """It prints as many as it is told to"""
    require_numbers(run)
'''
JUDGING = """
from autograder.authoring import expect, require_end


def require_numbers(run):
    require_end(run, within=10.0)
    wanted = " ".join(str(number) for number in range(1, run.params["to"] + 1))
    printed = " ".join(run.output("stdout").split())
    help = "Count from 1 to the first argument."
    expect(printed == wanted, expected=wanted, observed=printed or "nothing", help=help)
"""
PROGRAM = """import sys

for number in range(1, int(sys.argv[1]) + 1):
    print(number)
"""
KNOWN = {
    "correct/plain.py": f'"""Style: a loop."""\n{PROGRAM}',
    "faulty/only_three.py": '"""Fault: always counts to three\nCaught by: counts_to_any_number\n"""\nprint(1, 2, 3)\n',
    "faulty/from_nought.patch": """Fault: begins at 0
Caught by: counts_to_three

--- correct/plain.py
+++ faulty/from_nought.py
@@ -3,2 +3,2 @@
-for number in range(1, int(sys.argv[1]) + 1):
+for number in range(int(sys.argv[1]) + 1):
     print(number)
""",
}


def run(*arguments: str | Path, cwd: Path, status: int = 0) -> str:
    """Run `course`; return what it printed."""
    ran = course(*arguments, cwd=cwd)
    said = ran.stdout + ran.stderr
    assert ran.returncode == status, said
    return said


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A repository whose folder tasks/ holds one exercise."""
    folder = tmp_path / "tasks" / "counting"
    texts = {"scenarios.py": SCENARIOS, "checks.py": CHECKS, "hidden.py": HIDDEN, "judging.py": JUDGING}
    for name, text in {**texts, **{f"known/{name}": text for name, text in KNOWN.items()}}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    solution = f"%%writefile counting.py\n### BEGIN SOLUTION\n{PROGRAM}### END SOLUTION\n"
    metadata = {
        "grade": False,
        "grade_id": "solution",
        "locked": False,
        "schema_version": 3,
        "solution": True,
    }
    cells = [
        new_markdown_cell("# Count", id="title"),
        new_code_cell(solution, id="solution", metadata={"nbgrader": {**metadata, "task": False}}),
    ]
    nbformat.write(new_notebook(cells=cells), folder / "counting.ipynb")
    return tmp_path


@pytest.fixture
def installed(tmp_path: Path) -> Path:
    """The command of a toolkit that was installed from its wheel in an environment of its own."""
    uv = [sys.executable, "-m", "uv", "--no-config", "--system-certs"]
    bare = tmp_path / "bare"

    def do(*arguments: str | Path) -> None:
        ran = subprocess.run([*uv, *arguments], cwd=tmp_path, capture_output=True, text=True)
        assert ran.returncode == 0, ran.stderr

    build = ["--wheel", "--no-build-isolation", "--python", sys.executable, "--out-dir", "dist"]
    do("build", *build, PROJECT)
    do("venv", "--python", sys.executable, bare)
    (wheel,) = (tmp_path / "dist").glob("*.whl")
    constraints = ["--constraints", PROJECT / ".venv/constraints.txt"]
    do("pip", "install", "--python", bare / "bin/python", *constraints, f"{wheel}[ros-wheels]")
    return bare / "bin/course"


def test_an_installed_toolkit_audits_grades_checks_releases_and_makes_exercises(repository, installed):
    def run(*arguments: str | Path, status: int = 0) -> str:
        command = [installed, *arguments, "--course", repository / "tasks"]
        ran = subprocess.run(command, cwd=repository, env=PLAIN, capture_output=True, text=True)
        assert ran.returncode == status, ran.stdout + ran.stderr
        return ran.stdout

    assert "false failures: 0" in run("audit")

    run("release", "--exercises")
    released = (repository / "exercises/counting/counting.ipynb").read_text()
    assert "BEGIN SOLUTION" not in released
    assert "Hidden check 1 (2 points)" in released

    for student, program in {"anna": PROGRAM, "bert": "print(1, 2, 3)\n"}.items():
        (repository / "submitted" / student).mkdir(parents=True)
        (repository / "submitted" / student / "counting.py").write_text(program)
    grades = repository / "grades.json"
    run("grade", repository / "submitted", "--json", grades)
    assert {g["student"]: (g["status"], g["score"]) for g in json.loads(grades.read_text())} == {
        "anna": ("graded", 3),
        "bert": ("graded", 1),
    }

    (repository / "counting.py").write_text("print(1, 2)\n")
    assert "Count from 1 to the first argument" in run("check", "counting", status=1)

    run("new", "waves", "--kind", "service")
    assert (repository / "tasks/waves/checks.py").exists()


def test_without_isolation_a_check_says_so_and_is_made(repository, monkeypatch):
    monkeypatch.setenv("COURSE_ISOLATION", "none")
    (repository / "counting.py").write_text(PROGRAM)
    said = run("check", "counting", "--course", repository / "tasks", cwd=repository)
    assert "No isolation: COURSE_ISOLATION=none asks for no isolation" in said
    assert "All visible checks are run" in said


def test_its_archive_has_only_the_visible_checks(repository):
    run("release", "--out", "students.zip", "--course", repository / "tasks", cwd=repository)
    with zipfile.ZipFile(repository / "students.zip") as archive:
        names = {name.split("/", 1)[1] for name in archive.namelist()}
    ours = {name for name in names if "counting" in name}
    assert ours == {
        "exercises/counting/counting.ipynb",
        *(f".toolkit/checks/counting/{module}.py" for module in ("checks", "judging", "scenarios")),
    }
    assert not [name for name in names if "battery_service" in name and not name.startswith("chapters")]


@pytest.mark.parametrize(
    ("file", "text", "said"),
    [
        ("scenarios.py", "from .judging import x\n" + SCENARIOS, "the arena can read only this file of it"),
        ("scenarios.py", "def another(stage): ...\n", "'count', which"),
        (
            "hidden.py",
            HIDDEN + "\nagain = counts_to_any_number\nalso = check(points=1, on=FURTHER)(again.judge)\n",
            "two checks",
        ),
        ("checks.py", CHECKS.replace("counts_to_three", "counts"), "cannot import name"),
    ],
)
def test_faults_of_the_authors_files_are_reported(repository, file, text, said):
    (repository / "tasks/counting" / file).write_text(text)
    printed = run("audit", "--course", repository / "tasks", cwd=repository, status=2)
    assert said in " ".join(printed.split())


def test_a_folder_without_exercises_is_refused(tmp_path):
    assert "holds no exercise" in " ".join(run("audit", "--course", tmp_path, cwd=tmp_path, status=2).split())
