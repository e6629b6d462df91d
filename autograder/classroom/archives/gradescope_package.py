"""Writes the zip file for Gradescope's autograder: Gradescope's two scripts, and the part of the course that grades.

The zip file contains only visible checks, because a student's program runs in the same container.
"""

from __future__ import annotations

from pathlib import Path

from autograder.classroom.archives.student_bundle import (
    files_of,
    require_no_leak,
    visible_checks,
    write_archive,
)

TOP = "humanoid-course"  # the course's folder in /autograder/source
PARTS = (
    "LICENSE",
    "course",
    "pyproject.toml",
    "requirements.lock",
    "setup",
    "humanoid_interfaces",
    "ros_runtime",
    "robot_sim",
    "autograder/*.py",
    *(f"autograder/{room}" for room in ("arena", "authoring", "engine", "isolation", "recording", "report")),
    *(f"autograder/classroom/{part}" for part in ("__init__.py", "export", "on_gradescope")),
    *(f"autograder/classroom/commands/{name}.py" for name in ("__init__", "gradescope")),
    *(
        f"autograder/classroom/batch/{name}.py"
        for name in ("__init__", "collection", "records", "grades_without_run")
    ),
    *(f"course_cli/{name}.py" for name in ("__init__", "app", "ending", "help_text", "options", "own_work")),
    *(f"course_cli/commands/{name}.py" for name in ("__init__", "check")),
)
_SETUP = f"""#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the image: the launcher makes the course's environment.
export DEBIAN_FRONTEND=noninteractive
exec "${{GRADESCOPE_ROOT:-/autograder}}/source/{TOP}/course" --help
"""
_RUN = f"""#!/usr/bin/env bash
# Gradescope runs this for every upload, as root: the launcher grades the files in submission/.
root=${{GRADESCOPE_ROOT:-/autograder}}
exec "$root/source/{TOP}/course" gradescope --root "$root"
"""


def write_package(root: Path, archive: Path, exercise: str = "") -> int:
    """Write the package of the clone at `root`, for one exercise or for all; return the number of files in it.

    Raises `CommandFailed` when a file contains a solution or a hidden check.
    """
    files = {path.relative_to(root).as_posix(): path for path in files_of(root, PARTS)}
    files |= {name: path for name, path in visible_checks() if exercise in ("", path.parent.name)}
    require_no_leak(files)
    run = _RUN.rstrip("\n") + (f" --exercise {exercise}" if exercise else "") + "\n"
    content: dict[str, Path | str] = {f"{TOP}/{name}": path for name, path in files.items()}
    content |= {"setup.sh": _SETUP, "run_autograder": run}
    write_archive(archive, content)
    return len(content)
