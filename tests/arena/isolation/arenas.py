"""Runs small programs in arenas. It needs only the standard library and autograder.isolation, so any Python can run it.

As a program it runs the student code on stdin and prints the result of `run_student` as JSON.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import autograder.isolation
from autograder.isolation.arena_process import ArenaProcess, ArenaReport, ArenaSpec, Kind
from autograder.isolation.availability import available_isolation
from autograder.isolation.limits import ArenaLimits
from autograder.isolation.python_paths import python_read_only_paths

PACKAGE = Path(autograder.isolation.__file__).parent
ROS_RUNTIME = PACKAGE.parents[1] / "ros_runtime"
AGENT = Path(__file__).with_name("student_starter.py")  # the arena's trusted process
ENVIRONMENT = {
    "PYTHONPATH": f"{PACKAGE.parents[1]}:{AGENT.parent}",
    "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",  # else the wheels start the interpreter a second time
}


@dataclass
class StudentRun:
    """The observations of the trusted process about a student's program, and how the arena ended."""

    returncode: int
    stdout: str
    stderr: str
    lines: list[tuple[float, str, str]]
    codes: list[int]
    report: ArenaReport

    def json(self) -> Any:
        """The program's output, which is JSON."""
        assert self.returncode == 0, self.stderr
        return json.loads(self.stdout)


@dataclass
class Student:
    """A student's program, and what the trusted process does meanwhile (with `student` and `wait_for_line`)."""

    code: str
    meanwhile: str = ""
    arguments: list[str] = field(default_factory=list)
    files: dict[str, str] = field(default_factory=dict)
    env: dict[str, str] = field(default_factory=dict)
    limits: dict[str, int] = field(default_factory=dict)
    paths: list[str] = field(default_factory=list)
    arena_env: dict[str, str] = field(default_factory=dict)
    builds: bool = False  # it runs CMake

    def spec(self, limits: ArenaLimits) -> ArenaSpec:
        """The arena to run it in."""
        paths = [str(path) for path in python_read_only_paths()]
        task = {**self.__dict__, "paths": [*paths, *self.paths, str(ROS_RUNTIME)]}
        return ArenaSpec(
            [sys.executable, "-m", AGENT.stem],
            read_only_paths=[*paths, *self.paths, PACKAGE, ROS_RUNTIME, AGENT],
            env={**ENVIRONMENT, **self.arena_env},
            stdin=json.dumps(task).encode(),
            limits=limits,
        )


def run_student(student: Student, kind: Kind | None = None, deadline_s: float = 30.0) -> StudentRun:
    """Run the program in an arena to its end; an error of the trusted process raises an AssertionError here."""
    spec = student.spec(ArenaLimits(deadline_s=deadline_s, output_kib=8192))
    report = ArenaProcess(spec, kind or available_isolation().kind).wait()
    assert report.exit_code == 0, f"{report}\n{report.stdout.text}\n{report.stderr.text}"
    seen = json.loads(report.stdout.text.replace("\n", ""))
    return StudentRun(report=report, **seen)


def main() -> None:
    run = run_student(Student(sys.stdin.read()))
    json.dump({"returncode": run.returncode, "stdout": run.stdout, "stderr": run.stderr}, sys.stdout)


if __name__ == "__main__":
    main()
