"""The students' archive: everything to read, run and check, without solutions and hidden checks."""

from __future__ import annotations

import stat
import tempfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from autograder.classroom.nbgrader_bridge.release import generate_release
from autograder.engine.exercise import all_names, exercise_names, exercises_folder, file_names, load_exercise
from ros_runtime.course_error import COMMAND_FAILED, CourseError

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
    "chapters/support",
    "start_here.ipynb",
    "docs/any_machine.md",
    "docs/cheat_sheet.md",
    "docs/ci",
    "docs/glossary.md",
    "docs/images",
    "docs/recordings.md",
    "docs/robot.md",
    "docs/ros2_commands.md",
)
FOR_INSTRUCTORS = "autograder/classroom"  # `course` lists only commands whose modules exist
_DATED = (2026, 1, 1, 0, 0, 0)


class Leak(CourseError):
    """A file of the archive contains a solution or a hidden check."""

    exit_status = COMMAND_FAILED


def write_bundle(root: Path, archive: Path) -> int:
    """Write the students' archive of the clone at `root`; return how many files it holds.

    Raises `Leak` when a file contains a solution or a hidden check.
    """
    with tempfile.TemporaryDirectory() as temporary:
        exercises = Path(temporary) / "exercises"
        generate_release(exercises_folder(), exercises)
        files = {path.relative_to(root).as_posix(): path for path in files_of(root, PARTS, FOR_INSTRUCTORS)}
        files |= dict(visible_checks())
        # Freshly generated, because trying an exercise leaves a solution beside its notebook.
        files |= {path.relative_to(temporary).as_posix(): path for path in exercises.rglob("*.ipynb")}
        files["README.md"] = root / README
        require_no_leak(files)
        write_archive(archive, {f"{TOP}/{name}": path for name, path in files.items()})
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


def visible_checks() -> Iterator[tuple[str, Path]]:
    """Yield the modules with visible checks or a rubric, by the path at which a student's engine looks for them."""
    for exercise in all_names():
        for path in sorted((exercises_folder() / exercise).glob("*.py")):
            if path.name != "hidden.py" and path.name not in file_names(exercise):
                yield f"checks/{exercise}/{path.name}", path


def files_of(root: Path, parts: Sequence[str], kept_back: str = "") -> Iterator[Path]:
    """Yield the files of these parts of a clone, without what is derived and without the folder that is kept back."""
    for place in (place for part in parts for place in root.glob(part)):
        candidates = sorted(place.rglob("*")) if place.is_dir() else [place]
        for path in candidates:
            name = path.relative_to(root)
            is_hidden = name.parts[0] not in parts and any(part.startswith(".") for part in name.parts)
            is_kept_back = bool(kept_back) and name.is_relative_to(kept_back)
            if path.is_file() and not (is_hidden or is_kept_back or _is_derived(name)):
                yield path


def _is_derived(path: Path) -> bool:
    return "__pycache__" in path.parts or path.suffix == ".pyc"


def write_archive(archive: Path, files: Mapping[str, Path | str]) -> None:
    """Write a zip; `files` maps paths in it to files, or to texts, which become executable scripts."""
    archive.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as bundle:
        for name in sorted(files):
            source = files[name]
            entry = zipfile.ZipInfo(name, date_time=_DATED)
            runs = isinstance(source, str) or bool(source.stat().st_mode & stat.S_IXUSR)
            entry.external_attr = (stat.S_IFREG | (0o755 if runs else 0o644)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            bundle.writestr(entry, source if isinstance(source, str) else source.read_bytes())
