"""The students' archive has everything that they need, and no solutions."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import nbformat
import pytest
import yaml

from autograder.classroom.archives.released_part import part_of
from autograder.classroom.archives.student_bundle import TOP, hidden_check_ids, require_no_leak, write_bundle
from course_cli.kept_work import keep_work
from ros_runtime.course_error import CommandFailed, CourseError
from ros_runtime.project import TOOLKIT

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def archive(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("bundle") / "students.zip"
    write_bundle(ROOT, path)
    return path


@pytest.fixture(scope="module")
def unpacked(archive) -> Path:
    with zipfile.ZipFile(archive) as bundle:
        bundle.extractall(archive.parent)
    return archive.parent / TOP


def files(unpacked: Path) -> list[str]:
    return [path.relative_to(unpacked).as_posix() for path in unpacked.rglob("*") if path.is_file()]


def test_it_holds_no_solutions_hidden_checks_or_submissions(unpacked):
    names = files(unpacked)
    parts = [set(Path(name).parts) for name in names]
    assert not [each for each in parts if each & {"solutions", "tests", "hidden.py", "__pycache__", ".venv"}]
    reference = "def _reason_to_give_up"
    assert reference in (ROOT / "solutions/cancellable_walk/cancellable_walk.ipynb").read_text()
    of_an_essay = "safety_relay"
    assert of_an_essay in (ROOT / "solutions/arm_architecture/arm_architecture.ipynb").read_text()
    secrets = (reference, of_an_essay, "BEGIN SOLUTION", *hidden_check_ids())
    for name in names:
        content = (unpacked / name).read_bytes()
        for secret in secrets:
            assert secret.encode() not in content, name


def test_students_see_their_course_and_nothing_else(unpacked):
    seen = {path.name for path in unpacked.iterdir() if not path.name.startswith(".")}
    assert seen == {"README.md", "chapters", "course", "docs", "exercises", "start_here.ipynb"}
    chapters = {path.suffix or path.name for path in (unpacked / "chapters").iterdir()}
    assert chapters == {".ipynb", ".md", "images"}


def test_it_holds_what_students_work_with(unpacked):
    names = files(unpacked)
    for room in ("exercises", "chapters"):
        wanted = {
            path.relative_to(ROOT).as_posix()
            for path in (ROOT / room).rglob("*.ipynb")
            if "/." not in str(path)
        }
        assert wanted
        assert wanted <= set(names)


def test_its_launcher_can_be_executed(archive):
    with zipfile.ZipFile(archive) as bundle:
        assert bundle.getinfo(f"{TOP}/course").external_attr >> 16 & 0o111


def test_its_files_suffice_to_check_and_to_learn(unpacked):
    program = """
import importlib, pkgutil, sys
from pathlib import Path
here = Path.cwd()
import autograder, course_cli, lab, robot_sim, ros_cli, ros_runtime
for package in (autograder, course_cli, lab, robot_sim, ros_cli, ros_runtime):
    assert Path(package.__file__).is_relative_to(here), package.__file__
    for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
from robot_sim.model.build import build_model
from robot_sim.model.scenes import SCENES
for scene in SCENES:
    build_model(scene)
from autograder.engine.essay import load_essay
from autograder.engine.exercise import all_names, essay_names, exercise_names, load_exercise
for name in exercise_names():
    exercise = load_exercise(name, hidden=True)
    assert exercise.checks and not any(check.hidden for check in exercise.checks)
for name in essay_names():
    assert load_essay(name).criteria
print(*all_names())
"""
    environment = {**os.environ, "PYTHONPATH": str(unpacked / TOOLKIT), "PYTHONDONTWRITEBYTECODE": "1"}
    ran = subprocess.run(
        [sys.executable, "-c", program],
        cwd=unpacked / TOOLKIT,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.split() == sorted(path.stem for path in (ROOT / "exercises").rglob("*.ipynb"))


def test_its_commands_are_the_students(unpacked):
    environment = {
        **os.environ,
        "PYTHONPATH": str(unpacked / TOOLKIT),
        "PYTHONDONTWRITEBYTECODE": "1",
        "COLUMNS": "100",
    }
    program = "from course_cli.app import main; main(['--help'])"
    ran = subprocess.run(
        [sys.executable, "-c", program],
        cwd=unpacked,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    for command in ("check", "lab", "ros", "sim"):
        assert f" {command} " in ran.stdout
    for command in ("grade", "audit", "release"):
        assert f" {command} " not in ran.stdout


def test_its_readme_names_only_commands_that_students_have(unpacked):
    readme = (unpacked / "README.md").read_text()
    named = set(re.findall(r"\./course (\w+)", readme))
    assert {"lab", "check"} <= named
    assert all((unpacked / TOOLKIT / f"course_cli/commands/{name}.py").exists() for name in named)
    pictures = re.findall(r"\]\((\S+)\)", readme)
    assert all((unpacked / picture).exists() for picture in pictures)


def test_what_cells_have_written_beside_the_chapters_stays_here(unpacked):
    beside = [path for path in (unpacked / "chapters").rglob("*") if path.is_file()]
    assert {path.suffix for path in beside} == {".ipynb", ".md", ".svg"}


@pytest.fixture
def repository(unpacked, tmp_path) -> Path:
    """The archive in a student's repository, with this environment instead of one that the launcher would make."""
    folder = shutil.copytree(unpacked, tmp_path / "repository")
    launcher = f"exec {sys.executable} -c 'from course_cli.app import main; main()' \"$@\"\n"
    (folder / "course").write_text(f"#!/bin/sh\nexport PYTHONPATH={folder / TOOLKIT}\n{launcher}")
    (folder / "course").chmod(0o755)
    return folder


def lines_of_ci() -> list[str]:
    """The commands of both templates that check an exercise."""
    github, gitlab = (
        yaml.safe_load((ROOT / "docs/ci" / name).read_text())
        for name in ("github_actions.yml", "gitlab_ci.yml")
    )
    commands = [step.get("run", "") for step in github["jobs"]["check"]["steps"]] + gitlab["check"]["script"]
    lines = [line.replace("${{ matrix.exercise }}", "$EXERCISE") for line in commands if " check " in line]
    assert len(lines) == 2
    return lines


@pytest.mark.parametrize("right", [True, False], ids=["right", "wrong"])
def test_the_ci_commands_distinguish_a_correct_notebook_from_a_wrong_one(repository, right):
    notebook = repository / "exercises/patterns/patterns.ipynb"
    if right:
        program = (ROOT / "solutions/patterns/known/correct/lines_of_text.py").read_text()
        content = nbformat.read(notebook, as_version=4)
        next(
            cell for cell in content.cells if cell.id == "solution"
        ).source = f"%%writefile patterns.py\n{program}"
        nbformat.write(content, notebook)
    line = lines_of_ci()[right]
    ran = subprocess.run(
        ["bash", "-e", "-c", line],
        cwd=repository,
        env={
            **os.environ,
            "EXERCISE": "patterns",
            "COURSE_ISOLATION": "none",
        },  # as in most runners' containers
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == (0 if right else 1), ran.stdout + ran.stderr
    kept = json.loads((repository / "patterns.json").read_text())
    assert kept["status"] == "graded"
    assert (kept["score"] == kept["max_score"]) == right


def test_it_is_small_and_the_same_every_time(archive, tmp_path):
    assert archive.stat().st_size < 10e6
    write_bundle(ROOT, tmp_path / "again.zip")
    assert (tmp_path / "again.zip").read_bytes() == archive.read_bytes()


@pytest.mark.parametrize("secret", ["### BEGIN SOLUTION", *hidden_check_ids()[:2]])
def test_a_file_with_a_solution_or_hidden_check_stops_the_release(tmp_path, secret):
    leaking = tmp_path / "notes.md"
    leaking.write_text(f"by the way: {secret}\n")
    with pytest.raises(CommandFailed, match=r"chapters/notes\.md"):
        require_no_leak({"chapters/notes.md": leaking})


def test_a_class_gets_the_chapters_and_exercises_that_it_may_have_by_now(tmp_path):
    write_bundle(ROOT, tmp_path / "students.zip", part_of(ROOT / "chapters", [], until="2"))
    with zipfile.ZipFile(tmp_path / "students.zip") as bundle:
        bundle.extractall(tmp_path)
    course = tmp_path / TOP
    assert {path.name for path in (course / "chapters").glob("*.ipynb")} == {
        "01_robot_and_graph.ipynb",
        "02_services.ipynb",
    }
    exercises = {"patterns", "motor_services", "battery_service", "joint_query"}
    assert {path.name for path in (course / "exercises").iterdir()} == exercises
    assert {path.name for path in (course / TOOLKIT / "checks").iterdir()} == exercises
    assert "calibration" not in (course / "chapters/README.md").read_text()


def test_exercises_are_released_by_name(tmp_path):
    part = part_of(ROOT / "chapters", ["walk_to,patterns"])
    assert part.exercises == ["walk_to", "patterns"]
    page = part.contents(ROOT / "chapters/README.md")
    assert "[walk_to](../exercises/walk_to/walk_to.ipynb) (110), walk_client, not yet (110)" in page
    assert "12_design.ipynb" in page


@pytest.mark.parametrize(("wanted", "until"), [(["walk"], ""), ([], "14")])
def test_what_is_not_in_the_course_cannot_be_released(wanted, until):
    with pytest.raises(CourseError, match=r"there are: .*(walk_to|3a)"):
        part_of(ROOT / "chapters", wanted, until)


def test_a_newer_archive_unpacked_over_the_students_work_keeps_it(unpacked, tmp_path):
    course = shutil.copytree(unpacked, tmp_path / TOP)
    originals, name = course / TOOLKIT / "originals.json", "exercises/patterns/patterns.ipynb"
    notebook, released = course / name, (unpacked / name).read_text()
    assert keep_work(course, originals) == []
    notebook.write_text(released.replace("patterns", "my patterns", 1))
    assert keep_work(course, originals) == []

    newer = released + "\n"
    notebook.write_text(newer)
    hashes = json.loads(originals.read_text())
    originals.write_text(json.dumps({**hashes, name: hashlib.sha256(newer.encode()).hexdigest()}))
    sentences = keep_work(course, originals)

    assert "my patterns" in notebook.read_text()
    assert (course / "newer" / name).read_text() == newer
    assert [name in sentence for sentence in sentences] == [True, True]
    assert keep_work(course, originals) == []
    assert (course / "chapters/02_services.ipynb").read_text() == (
        unpacked / "chapters/02_services.ipynb"
    ).read_text()


def test_jupyterlab_copies_a_notebook_when_it_is_saved(unpacked, tmp_path):
    course = shutil.copytree(unpacked, tmp_path / TOP)
    program = """
import asyncio
from jupyter_server.serverapp import ServerApp
server = ServerApp()
server.initialize([], new_httpserver=False)
model = asyncio.run(server.contents_manager.get("exercises/patterns/patterns.ipynb"))
model["content"]["cells"][0]["source"] += " mine"
asyncio.run(server.contents_manager.save(model, "exercises/patterns/patterns.ipynb"))
"""
    toolkit = course / TOOLKIT
    settings = {"PYTHONPATH": str(toolkit), "JUPYTER_CONFIG_PATH": str(toolkit / "course_cli/jupyter")}
    ended = subprocess.run(
        [sys.executable, "-c", program],
        cwd=course,
        env={**os.environ, **settings, "HOME": str(tmp_path)},
        stderr=subprocess.PIPE,
        text=True,
        check=True,
    )
    assert "UserWarning" not in ended.stderr
    assert " mine" in (course / ".kept/exercises/patterns/patterns.ipynb").read_text()


def test_a_damaged_record_of_the_release_loses_no_work(unpacked, tmp_path):
    course = shutil.copytree(unpacked, tmp_path / TOP)
    originals, notebook = course / TOOLKIT / "originals.json", course / "exercises/patterns/patterns.ipynb"
    notebook.write_text("mine")
    keep_work(course, originals)
    (course / ".kept/originals.json").write_text("{")
    shutil.copyfile(unpacked / "exercises/patterns/patterns.ipynb", notebook)
    (sentence,) = keep_work(course, originals)
    assert "is as you left it" in sentence
    assert notebook.read_text() == "mine"
