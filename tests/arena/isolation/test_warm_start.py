"""A program that a waiting interpreter becomes cannot be told from one that was started, by itself or by others."""

from __future__ import annotations

import pytest
from arenas import Student, run_student

from ros_runtime.environment import ros_environment

EXIT_BY = {
    "the end of the file": "print('done')",
    "sys.exit": "import sys; sys.exit(3)",
    "a message": "raise SystemExit('could not')",
    "an exception": "def fail():\n    raise ValueError('no')\nfail()",
    "a missing import": "print('before')\nnumpy.zeros(3)",
    "a syntax error": "def broken(:\n    pass",
    "a signal": "import os, signal; os.kill(os.getpid(), signal.SIGTERM)",
    "Ctrl-C": "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(5)",
    "a thread": "import threading, time\n"
    "threading.Thread(target=lambda: (time.sleep(0.2), print('from the thread'))).start()",
    "a function at exit": "import atexit; atexit.register(print, 'at exit')",
    "os._exit": "import os; os._exit(7)",
}

ITSELF = """
import json, os, resource, signal, sys
loaded = sorted(sys.modules)
import time
def processes():
    return [p for p in os.listdir("/proc") if p.isdigit()]
deadline = time.monotonic() + 10
while len(processes()) > 3 and time.monotonic() < deadline:  # LTTng, which rclpy brings along, forks for a moment
    time.sleep(0.01)
status = dict(line.split(":\\t", 1) for line in open("/proc/self/status").read().splitlines())
# signals above 31 are the C library's own affair
status["SigCgt"] = f"{int(status['SigCgt'], 16) & 0x7fffffff:x}"
names = ("CapInh", "CapPrm", "CapEff", "CapBnd", "CapAmb", "NoNewPrivs", "Seccomp")
names += ("Uid", "Gid", "Groups", "SigBlk", "SigIgn", "SigCgt")
limits = {name: resource.getrlimit(getattr(resource, name)) for name in dir(resource) if name[:6] == "RLIMIT"}
environment = {name: value for name, value in os.environ.items()}
print(json.dumps({
    "argv": sys.argv, "orig_argv": sys.orig_argv[1:], "path": sys.path, "loaded": loaded, "main": sorted(globals()),
    "file": __file__, "name": __name__, "flags": list(sys.flags), "status": {name: status[name] for name in names},
    "limits": limits, "environment": environment, "folder": os.getcwd(), "listing": os.listdir("."),
    "descriptors": sorted(os.listdir("/proc/self/fd"), key=int)[:5], "session": os.getsid(0) == os.getpid(),
    "mounts": sorted(line.split()[4] for line in open("/proc/self/mountinfo")),
    "sigint": signal.getsignal(signal.SIGINT) is signal.default_int_handler, "umask": os.umask(0o22),
    "line_buffering": sys.stdout.line_buffering, "encoding": sys.stdout.encoding,
    "processes": len(processes()) <= 3,
}, indent=0))
"""

IMPORTS = """
import json, sys
fresh = set(sys.modules)
def seen(statement):
    exec(statement, {})
    rclpy = sys.modules.get("rclpy")
    attributes = sorted(name for name in vars(rclpy) if not name.startswith("__")) if rclpy else []
    return statement, sorted(set(sys.modules) - fresh), attributes
steps = ["import rclpy", "from rclpy.node import Node", "import rclpy.action", "import numpy as np", "import asyncio",
         "from rclpy.executors import MultiThreadedExecutor, ExternalShutdownException", "import importlib.util",
         "from humanoid_interfaces.srv import GetBatteryStatus", "from nav_msgs.msg import Odometry", "import yaml"]
print(json.dumps([seen(step) for step in steps], indent=0))
"""

# Found under names of their own by those who made them, whether or not they are imported: they name nothing to import.
UNIMPORTABLE = (
    "cython_runtime",
    "_cython_",
    "importlib._bootstrap",
    "typing.io",
    "typing.re",
    "service_introspection",
)


def in_both(namespaces, code, **options):
    env = {**ros_environment(), "PYTHONFAULTHANDLER": "1", **options.pop("env", {})}
    return [run_student(Student(code, warm=warm, env=env, **options), namespaces) for warm in (False, True)]


@pytest.mark.parametrize("code", EXIT_BY.values(), ids=EXIT_BY)
def test_it_ends_as_it_would(namespaces, code):
    cold, warm = in_both(namespaces, code)
    assert (warm.returncode, warm.stdout, warm.stderr) == (cold.returncode, cold.stdout, cold.stderr)


def test_it_finds_itself_as_it_would(namespaces):
    cold, warm = (
        run.json() for run in in_both(namespaces, ITSELF, arguments=["a", "--b"], env={"GIVEN": "1"})
    )
    for seen in (cold, warm):
        seen["loaded"] = [name for name in seen["loaded"] if not any(odd in name for odd in UNIMPORTABLE)]
    for what, value in cold.items():
        assert {what: warm[what]} == {what: value}


def test_every_import_brings_in_what_it_would(namespaces):
    cold, warm = (run.json() for run in in_both(namespaces, IMPORTS))
    for (statement, loaded, attributes), (_, loaded_warm, attributes_warm) in zip(cold, warm, strict=True):
        missing, extra = set(loaded) - set(loaded_warm), set(loaded_warm) - set(loaded)
        odd = {name for name in missing if any(part in name for part in UNIMPORTABLE)}
        assert (statement, missing - odd, extra) == (statement, set(), set())
        assert attributes_warm == attributes


def test_random_numbers_differ_from_program_to_program(namespaces):
    code = "import random, numpy, uuid; print(random.random(), numpy.random.random(), uuid.uuid4())"
    twice = "wait_for_line('.')\nstudent.wait()\nstudent = start()\nstudent.wait()"
    lines = [
        line[2]
        for line in run_student(
            Student(code, warm=True, env=ros_environment(), meanwhile=twice), namespaces
        ).lines
    ]
    assert len(lines) == 2
    assert not set(lines[0].split()) & set(lines[1].split())


def test_the_interpreter_it_came_from_holds_nothing_of_the_grader(namespaces):
    """Neither the arena's folders, nor its modules, nor its environment are in the memory the program can read."""
    code = """
import re, sys, gc
found = set()
for line in open("/proc/self/maps"):
    span, rights, *_, path = (*line.split()[:2], line.split()[-1])
    if "r" not in rights or "[v" in path:
        continue
    first, last = (int(part, 16) for part in span.split("-"))
    with open("/proc/self/mem", "rb") as memory:
        memory.seek(first)
        try:
            found |= {word.decode() for word in re.findall(rb"autograder[./][a-z_./]+", memory.read(last - first))}
        except OSError:
            pass
print(sorted(found - {"autograder[./"}))
"""
    run = run_student(Student(code, warm=True, env=ros_environment()), namespaces)
    assert run.stdout.strip() == "[]", run.stdout + run.stderr


def test_what_one_program_leaves_is_not_there_for_the_next(namespaces):
    leaving = """
import os, time
traces = [folder for folder in ("/tmp", "/dev/shm") if os.path.exists(folder + "/trace")]
print("left", os.listdir("/tmp/work"), traces, flush=True)
for folder in ("/tmp/work", "/tmp", "/dev/shm"):
    open(folder + "/trace", "w").write("I was here")
if os.fork() == 0:
    os.setsid()
    time.sleep(60)
"""
    twice = "student.wait()\nstudent = start()\nstudent.wait()"
    run = run_student(Student(leaving, warm=True, meanwhile=twice), namespaces)
    assert [line[2] for line in run.lines] == ["left ['node.py'] []"] * 2
    assert run.report.nothing_survives
