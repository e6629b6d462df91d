"""The students' archive: everything to read, run and check, without solutions and hidden checks."""

from __future__ import annotations

import stat
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path

from autograder.engine.exercise import all_names, exercise_names, exercises_folder, file_names, load_exercise
from autograder.nbgrader_bridge.release import generate_release

TOP = "humanoid-course"  # the folder the archive unpacks to
README = "docs/for_students.md"  # becomes their README.md; the clone's own is for instructors
PARTS = (
    ".devcontainer",
    ".dockerignore",
    "Dockerfile",
    "LICENSE",
    "binder",
    "course",
    "pyproject.toml",
    "requirements.lock",
    "setup",
    "humanoid_interfaces",
    "ros_runtime",
    "ros_cli",
    "robot_sim",
    "lab",
    "autograder",
    "course_cli",
    "chapters/*.ipynb",
    "chapters/README.md",
    "chapters/images",
    "start_here.ipynb",
    "docs/any_machine.md",
    "docs/cheat_sheet.md",
    "docs/ci",
    "docs/glossary.md",
    "docs/images",
    "docs/robot.md",
    "docs/ros2_commands.md",
)
# For instructors only. `course` lists only commands whose modules exist.
KEPT_BACK = (
    "autograder/audit",
    "autograder/authoring/standard_hidden.py",
    "autograder/batch",
    "autograder/nbgrader_bridge",
    "autograder/new_exercise",
    "autograder/report/classroom",
    "course_cli/class_output.py",
    "course_cli/student_bundle.py",
    *(
        f"course_cli/commands/{name}.py"
        for name in ("audit", "bench", "book", "demo", "grade", "merge", "new", "rehearse", "release", "test")
    ),
)
_DATED = (2026, 1, 1, 0, 0, 0)  # a fixed date makes the archive reproducible


class Leak(Exception):
    """A file of the archive contains what students must not see."""


def write_bundle(root: Path, archive: Path) -> int:
    """Write the students' archive of the clone at `root`; return how many files it holds.

    Raises `Leak` when a file contains a solution or a hidden check.
    """
    with tempfile.TemporaryDirectory() as temporary:
        exercises = Path(temporary) / "exercises"
        generate_release(exercises_folder(), exercises)
        files = {path.relative_to(root).as_posix(): path for path in _files_of(root)}
        files |= dict(_visible_checks())
        # Freshly generated, because trying an exercise leaves a solution beside its notebook.
        files |= {path.relative_to(temporary).as_posix(): path for path in exercises.rglob("*.ipynb")}
        files["README.md"] = root / README
        require_no_leak(files)
        archive.parent.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as bundle:
            for name in sorted(files):
                _add(bundle, name, files[name])
    return len(files)


def require_no_leak(files: Mapping[str, Path]) -> None:
    """Raise `Leak` when a file names a hidden check or contains a solution."""
    forbidden = ["### BEGIN SOLUTION", *hidden_check_ids()]
    for name, path in files.items():
        content = path.read_bytes()
        found = next((word for word in forbidden if word.encode() in content), None)
        if found or path.name == "hidden.py":
            raise Leak(
                f"{name} would show students {found or 'hidden checks'!r}; keep it back or take that out of it"
            )


def hidden_check_ids() -> list[str]:
    """Return the ids of the hidden checks, without those that another exercise has as a visible one."""
    checks = [check for name in exercise_names() for check in load_exercise(name, hidden=True).checks]
    shown = {check.id for check in checks if not check.hidden}
    return [check.id for check in checks if check.hidden and check.id not in shown]


def _visible_checks() -> Iterator[tuple[str, Path]]:
    """The modules with visible checks or a rubric, by the path at which a student's engine looks for them."""
    for exercise in all_names():
        for path in sorted((exercises_folder() / exercise).glob("*.py")):
            if path.name != "hidden.py" and path.name not in file_names(exercise):
                yield f"checks/{exercise}/{path.name}", path


def _files_of(root: Path) -> Iterator[Path]:
    for place in (place for part in PARTS for place in root.glob(part)):
        candidates = sorted(place.rglob("*")) if place.is_dir() else [place]
        yield from (path for path in candidates if path.is_file() and not _kept_back(path.relative_to(root)))


def _kept_back(path: Path) -> bool:
    hidden = any(part.startswith(".") for part in path.parts) and path.parts[0] not in PARTS
    derived = "__pycache__" in path.parts or path.suffix == ".pyc"
    return hidden or derived or path.as_posix().startswith(KEPT_BACK)


def _add(bundle: zipfile.ZipFile, name: str, path: Path) -> None:
    entry = zipfile.ZipInfo(f"{TOP}/{name}", date_time=_DATED)
    executable = path.stat().st_mode & stat.S_IXUSR
    entry.external_attr = (stat.S_IFREG | (0o755 if executable else 0o644)) << 16
    entry.compress_type = zipfile.ZIP_DEFLATED
    bundle.writestr(entry, path.read_bytes())
