"""Writes the students' archive: everything to read, run and check, without solutions and hidden checks."""

from __future__ import annotations

import json
import stat
import tempfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from autograder.classroom.archives.released_part import Part
from autograder.classroom.nbgrader_bridge.release import generate_release
from autograder.engine.exercise import all_names, exercise_names, exercises_folder, file_names, load_exercise
from course_cli.kept_work import ORIGINALS, sha256_of
from ros_runtime.course_error import CommandFailed
from ros_runtime.project import TOOLKIT

TOP = "humanoid-course"  # the folder the archive unpacks to
README = "docs/for_students.md"  # the archive's README.md; the clone's README.md is for instructors
# What students see, and what other programs look for beside it: editors, Docker, Binder.
SHOWN = (
    ".binder",
    ".devcontainer",
    ".dockerignore",
    "chapters/*.ipynb",
    "chapters/README.md",
    "chapters/images",
    "course",
    "docs/accessibility.md",
    "docs/any_machine.md",
    "docs/cheat_sheet.md",
    "docs/glossary.md",
    *(f"docs/images/{name}.png" for name in ("lab", "replay", "self_check", "view")),
    "docs/recordings.md",
    "docs/robot.md",
    "docs/ros2_commands.md",
    "start_here.ipynb",
)
# The toolkit, in a hidden folder.
PARTS = (
    "LICENSE",
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
    "chapters/support",
)
FOR_INSTRUCTORS = "autograder/classroom"  # `course` lists only commands whose modules exist
CONTENTS = "chapters/README.md"  # its table lists the chapters and their exercises
IGNORED = ".venv/\nbuild/\n__pycache__/\n"  # by git, in the repository of a student
_ENTRY_DATE = (2026, 1, 1, 0, 0, 0)  # of every file, so that the same content gives the same archive


def write_bundle(root: Path, archive: Path, part: Part | None = None) -> int:
    """Write the students' archive of the clone at `root`, all of it or a part; return how many files it holds.

    Raises `CommandFailed` when a file contains a solution or a hidden check.
    """
    part = part or Part(None, all_names())
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        generate_release(exercises_folder(), folder / "exercises")
        shown = {path.relative_to(root).as_posix(): path for path in files_of(root, SHOWN) if part.has(path)}
        # Freshly generated, because trying an exercise leaves a solution beside its notebook.
        notebooks = sorted((folder / "exercises").rglob("*.ipynb"))
        shown |= {path.relative_to(folder).as_posix(): path for path in notebooks if part.has(path)}
        shown["README.md"] = root / README
        shown[CONTENTS] = _written(folder / "contents.md", part.contents(root / CONTENTS))
        hidden = {path.relative_to(root).as_posix(): path for path in files_of(root, PARTS, FOR_INSTRUCTORS)}
        hidden |= {name: path for name, path in visible_checks() if path.parent.name in part.exercises}
        hidden[".gitignore"] = _written(folder / "gitignore", IGNORED)
        hidden[ORIGINALS.name] = _written(folder / "originals.json", _hashes(shown))
        files = {**shown, **{f"{TOOLKIT}/{name}": path for name, path in hidden.items()}}
        require_no_leak(files)
        write_archive(archive, {f"{TOP}/{name}": path for name, path in files.items()})
    return len(files)


def _written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def _hashes(files: Mapping[str, Path]) -> str:
    """Return the SHA-256 of each notebook by its path, as JSON."""
    notebooks = {name: path for name, path in sorted(files.items()) if path.suffix == ".ipynb"}
    return json.dumps({name: sha256_of(path) for name, path in notebooks.items()}, indent=1) + "\n"


def require_no_leak(files: Mapping[str, Path]) -> None:
    """Raise `CommandFailed` when a file names a hidden check or contains a solution."""
    forbidden = ["### BEGIN SOLUTION", *hidden_check_ids()]
    for name, path in files.items():
        content = path.read_bytes()
        found = next((word for word in forbidden if word.encode() in content), None)
        if found or path.name == "hidden.py":
            raise CommandFailed(
                f"{name} would show students {found or 'hidden checks'!r}; leave the file out, or remove this text"
            )


def hidden_check_ids() -> list[str]:
    """Return the ids of the hidden checks, except ids that another exercise uses for a visible check."""
    checks = [check for name in exercise_names() for check in load_exercise(name, hidden=True).checks]
    shown = {check.id for check in checks if not check.hidden}
    return [check.id for check in checks if check.hidden and check.id not in shown]


def visible_checks() -> Iterator[tuple[str, Path]]:
    """Yield each module with visible checks or a rubric, with the path in the archive where the engine finds it."""
    for exercise in all_names():
        for path in sorted((exercises_folder() / exercise).glob("*.py")):
            if path.name != "hidden.py" and path.name not in file_names(exercise):
                yield f"checks/{exercise}/{path.name}", path


def files_of(root: Path, parts: Sequence[str], excluded: str = "") -> Iterator[Path]:
    """Yield the files of these parts of a clone, without derived files and without the folder `excluded`."""
    for place in (place for part in parts for place in root.glob(part)):
        candidates = sorted(place.rglob("*")) if place.is_dir() else [place]
        for path in candidates:
            name = path.relative_to(root)
            is_hidden = name.parts[0] not in parts and any(part.startswith(".") for part in name.parts)
            is_excluded = bool(excluded) and name.is_relative_to(excluded)
            if path.is_file() and not (is_hidden or is_excluded or _is_derived(name)):
                yield path


def _is_derived(path: Path) -> bool:
    return "__pycache__" in path.parts or path.suffix == ".pyc"


def write_archive(archive: Path, files: Mapping[str, Path | str]) -> None:
    """Write a zip file; `files` maps each path in it to a file, or to the text of an executable script."""
    archive.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as bundle:
        for name in sorted(files):
            source = files[name]
            entry = zipfile.ZipInfo(name, date_time=_ENTRY_DATE)
            is_executable = isinstance(source, str) or bool(source.stat().st_mode & stat.S_IXUSR)
            entry.external_attr = (stat.S_IFREG | (0o755 if is_executable else 0o644)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            bundle.writestr(entry, source if isinstance(source, str) else source.read_bytes())
