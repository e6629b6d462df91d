"""The kernel's view of a student's processes, from outside, is what docs/grading.md promises."""

from __future__ import annotations

import json
import os
from pathlib import Path

from arenas import Student, run_student

import student_posture
from autograder.isolation.arena_process import Kind

# A program with threads, a child, and a child in a session of its own.
CODE = """
import json, os, signal, subprocess, threading
for _ in range(2):
    threading.Thread(target=threading.Event().wait, daemon=True).start()
sleep = ["/bin/sleep", "60"]
children = [subprocess.Popen(sleep), subprocess.Popen(sleep, start_new_session=True)]
print(json.dumps([os.getpid(), *(child.pid for child in children)]))
input()
for child in children:
    child.kill()
"""

# The trusted process inspects every process of the sandbox, by its process id inside.
LOOK = f"""
import sys
from pathlib import Path
sys.path.append({str(Path(student_posture.__file__).parent)!r})
from student_posture import posture
wait_for_line("]")
ours = os.readlink("/proc/self/ns/pid")
for pid in student.processes():
    inside = Path(f"/proc/{{pid}}/status").read_text().partition("NSpid:")[2].splitlines()[0].split()[-1]
    if os.readlink(f"/proc/{{pid}}/ns/pid") != ours:
        lines.append((0.0, inside, json.dumps(posture(pid))))
links = {{kind: os.readlink(f"/proc/self/ns/{{kind}}") for kind in os.listdir("/proc/self/ns")}}
lines.append((0.0, "arena", json.dumps(links)))
student.write_line("")
"""

OF_EVERY_PROCESS = (
    "capabilities",
    "new privileges",
    "system calls",
    "own namespaces",
    "network",
    "user",
    "writable",
)


def test_a_students_process_is_confined_as_promised(namespaces: Kind) -> None:
    run = run_student(Student(CODE, LOOK, paths=[student_posture.__file__]), namespaces)
    assert run.returncode == 0, run.stderr
    printed = json.loads(next(text for _, stream, text in run.lines if stream == "stdout"))
    seen = {stream: json.loads(text) for _, stream, text in run.lines if stream.isdigit()}
    promised = {what: value for what, (value, _) in student_posture.PROMISES.items()}
    assert {str(pid) for pid in (1, *printed)} <= set(seen)
    for pid in printed:
        assert seen[str(pid)] == promised
    for of_one in seen.values():  # the sandbox's own, too
        assert {what: of_one[what] for what in OF_EVERY_PROCESS} == {
            what: promised[what] for what in OF_EVERY_PROCESS
        }
    arena = next(json.loads(text) for _, stream, text in run.lines if stream == "arena")
    for kind in ("ipc", "mnt", "net", "pid", "user", "uts"):
        assert arena[kind] != os.readlink(f"/proc/self/ns/{kind}")
