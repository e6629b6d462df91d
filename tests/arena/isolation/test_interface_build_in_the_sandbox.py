"""A student's interface files are built in the student's sandbox, with its limits and without a network."""

from __future__ import annotations

from pathlib import Path

import pytest
from arenas import Student, run_student

import ros_runtime
from autograder.isolation.arena_process import Kind
from ros_runtime.environment import ros_environment

pytest.importorskip("rclpy")

_BUILD_AND_IMPORT = """
import json, os, subprocess, sys
command = [sys.executable, "-m", "ros_runtime.interface_build", ".", "/tmp/built", "--name", "my_interfaces"]
built = subprocess.run(command, capture_output=True, text=True)
report = json.loads(built.stdout)
environment = {**os.environ, **report["environment"]}
environment["LD_LIBRARY_PATH"] += ":" + os.environ["LD_LIBRARY_PATH"]
use = "from rclpy.serialization import serialize_message as pack; from my_interfaces.srv import Ask; "
use += "print(len(pack(Ask.Request())))"
used = subprocess.run([sys.executable, "-c", use], env=environment, capture_output=True, text=True)
print(json.dumps([built.returncode, list(report["types"]), used.stdout, used.stderr]))
"""


def test_it_builds_and_a_process_beside_it_imports_it(namespaces: Kind) -> None:
    runtime = Path(ros_runtime.__file__).parent
    student = Student(
        _BUILD_AND_IMPORT,
        files={"Ask.srv": "float64 speed\n---\nbool asked\n"},
        env={**ros_environment(), "PYTHONPATH": str(runtime.parent)},
        arena_env=ros_environment(),
        paths=[str(runtime)],
        builds=True,
    )
    status, types, printed, complaints = run_student(student, namespaces, deadline_s=600.0).json()
    assert (status, types, complaints) == (0, ["my_interfaces/srv/Ask"], "")
    assert printed == "12\n"  # bytes: four that announce the encoding, eight of the float64
