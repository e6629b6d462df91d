"""docs/from_github_classroom.md, carried out: bare repositories on a disk are in the place of GitHub."""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections.abc import Mapping
from pathlib import Path

import nbformat

from autograder.classroom.audit.known_submission import KnownSubmission, known_submissions
from autograder.engine.exercise import load_exercise
from ros_runtime.project import PROJECT

EXERCISE = "patterns"
PAGE = (PROJECT / "docs/from_github_classroom.md").read_text()
TEMPLATE, _ON_GITHUB, STUDENT, COLLECT, FEEDBACK = re.findall(
    r"^```bash\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL
)
IN_TIME, LATE = "2026-12-01 12:00", "2027-01-01 12:00"  # before and after the page's deadline
ABOUT_A_COMMIT = {"NAME": "Anna", "EMAIL": "anna@example.org", "DATE": IN_TIME}


def git_variables(**about: str) -> dict[str, str]:
    """The environment variables from which git takes author and committer of a commit."""
    return {f"GIT_{who}_{what}": value for who in ("AUTHOR", "COMMITTER") for what, value in about.items()}


def run(script: str, folder: Path, **variables: str) -> str:
    done = subprocess.run(
        ["bash", "-eu", "-c", script],
        cwd=folder,
        env={**os.environ, **git_variables(**ABOUT_A_COMMIT), "COLUMNS": "200", **variables},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def ten() -> dict[str, KnownSubmission]:
    """Ten known submissions by their students' names, some of which have hyphens, as GitHub's have."""
    known = {one.name: one for one in known_submissions(EXERCISE)}
    correct = [one for name, one in known.items() if name.startswith("correct/")]
    others = [one for one in known.values() if one.kind == "faulty" and one.path.stem != "untouched_starter"]
    chosen = [*correct, *others, known["hostile/every_answer"]]
    return {f"user-{number}": one for number, one in enumerate([*chosen[:9], chosen[-1]])}


def write_program(exercises: Path, source: str, *, as_notebook: bool) -> None:
    """Write a student's program, or change the notebook's cell that writes it."""
    if not as_notebook:
        (exercises / EXERCISE / f"{EXERCISE}.py").write_text(source)
        return
    path = exercises / EXERCISE / f"{EXERCISE}.ipynb"
    notebook = nbformat.read(path, as_version=4)
    (cell,) = (cell for cell in notebook.cells if cell.source.startswith(f"%%writefile {EXERCISE}.py"))
    cell.source = f"%%writefile {EXERCISE}.py\n{source}"
    nbformat.write(notebook, path)


def hand_in(folder: Path, host: Mapping[str, str], user: str, source: str, number: int) -> None:
    """Carry out the student's steps, without the lab; then push a late commit, which must not count."""
    steps = re.sub(r"^(cd|\./course) .*\n", "", STUDENT, flags=re.MULTILINE)
    clone, _, commit = steps.partition("\n")
    run(clone.replace(" robotics ", f" {user} "), folder, user=user, **host)
    write_program(folder / user / "exercises", source, as_notebook=number % 2 == 0)
    run(commit, folder / user)
    write_program(folder / user / "exercises", "print('too late')\n", as_notebook=False)
    run(commit, folder / user, **git_variables(DATE=LATE))


def test_ten_students_hand_in_by_pushing_and_are_graded_and_answered(tmp_path: Path) -> None:
    class_folder, disk, homes = (tmp_path / name for name in ("class", "github", "homes"))
    for folder in (class_folder, disk, homes):
        folder.mkdir()
    host = {"HOST": f"file://{disk}"}
    students = ten()
    (class_folder / "roster.txt").write_text("\n".join([*students, "pushed-nothing"]))

    run(TEMPLATE.replace("PATH/OF/YOUR/CLONE", str(PROJECT)), class_folder)
    for number, user in enumerate([*students, "pushed-nothing"]):
        run(f"git clone -q --bare {class_folder}/humanoid-course robotics-{user}.git", disk)
        if user in students:
            source = students[user].read().sources[f"{EXERCISE}.py"]
            hand_in(homes, host, user, source, number)
    said = run(COLLECT, class_folder, **host)
    assert "11 submissions written to submitted; 11 students in all" in said
    assert said.count("left aside: ") == said.count("patterns.ipynb is the unchanged starter") == 5

    grades = json.loads((class_folder / "graded/grades.json").read_text())
    failed = {
        grade["student"]: {check["id"] for check in grade["checks"] if check["status"] == "failed"}
        for grade in (grades if isinstance(grades, list) else grades["grades"])
    }
    assert failed.keys() == {*students, "pushed-nothing"}
    for user, known in students.items():
        assert set(known.caught_by) <= failed[user] <= {*known.caught_by, *known.also_fails}, known.name
    assert failed["pushed-nothing"]

    run(FEEDBACK, class_folder, **host)
    run("git fetch -q && git worktree add -q feedback origin/feedback", homes / "user-9")
    page = (homes / f"user-9/feedback/{EXERCISE}.html").read_text()
    hidden = [check.title for check in load_exercise(EXERCISE, hidden=True).checks if check.hidden]
    assert "points" in page
    assert not any(title in page for title in hidden)
    assert f"{EXERCISE}.html" in (homes / "user-9/feedback/index.html").read_text()
