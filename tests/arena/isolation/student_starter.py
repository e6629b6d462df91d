"""The trusted process of a test arena: starts the student's program described on stdin, prints observations as JSON."""

from __future__ import annotations

import json
import os  # noqa: F401  (it and time are for what a test does meanwhile)
import sys
import threading
import time  # noqa: F401

from autograder.isolation.limits import StudentLimits
from autograder.isolation.student_process import StudentProcess
from autograder.isolation.student_sandbox import Program

task = json.load(sys.stdin)
lines: list[tuple[float, str, str]] = []
codes: list[int] = []
printed = threading.Condition()


def on_line(*line):
    with printed:
        lines.append(line)
        printed.notify_all()


def wait_for_line(text):
    """Wait until the program has printed a line; for the code that a test runs meanwhile."""
    with printed:
        assert printed.wait_for(lambda: any(text in line[2] for line in lines), 20), lines


def start() -> StudentProcess:
    """Start the program; a test may start it several times."""
    program = Program(
        ["node.py", *task["arguments"]],
        workdir_files={"node.py": task["code"].encode(), **{n: t.encode() for n, t in task["files"].items()}},
        env={"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1", **task["env"]},
        read_only_paths=task["paths"],
        limits=StudentLimits(**task["limits"]),
        builds=task["builds"],
    )
    return StudentProcess(program, on_line, codes.append)


student = start()
exec(task["meanwhile"])
student.wait()
seen = {"lines": lines, "stdout": student.stdout.text, "stderr": student.stderr.text}
json.dump({"returncode": student.returncode, "codes": codes, **seen}, sys.stdout)
