"""The arena of a submission: what its scenarios share, and how it is separated from other scenarios and submissions."""

from __future__ import annotations

import os
import re

import pytest

from autograder.authoring.checks import Scenario
from autograder.authoring.evidence import events as ev
from autograder.engine.arena_run import ArenaRun, NotGraded, run_in_arena
from autograder.engine.exercise import Exercise, exercises_folder
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import available_isolation
from autograder.isolation.process_tree import descendants

pytestmark = pytest.mark.skipif(
    not available_isolation().trusted, reason=f"no namespaces here: {available_isolation().reason}"
)
QUIZ = Exercise("patterns", exercises_folder() / "patterns", ())
PROGRAM = Scenario("print_answers", robot=None, student="program")

# It leaves a process that ignores signals, files, a socket and shared memory, and searches for all of them.
LEAVES_TRACES = """
import os, signal, socket, sys, time
me = str(os.getpid())
family = {"1", me}  # with the init of its sandbox; LTTng has a child for a moment
stats = []
for name in os.listdir("/proc"):
    try:
        stats += [open(f"/proc/{name}/stat").read().split()] if name.isdigit() else []
    except (FileNotFoundError, ProcessLookupError):
        pass  # it has just ended
print("others", [pid for pid, _name, _state, parent, *_ in stats if pid not in family and parent != me])
traces = [folder for folder in ("/tmp", "/dev/shm") if os.path.exists(folder + "/trace")]
print("files", os.listdir("."), traces)
print("domain", os.environ["ROS_DOMAIN_ID"])
left = socket.socket(socket.AF_UNIX)
try:
    left.connect("\\0trace")
    print("socket", "somebody answers")
except OSError:
    print("socket", "nobody answers")
for folder in (".", "/tmp", "/dev/shm"):
    open(folder + "/trace", "w").write("I was here")
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        for number in set(signal.Signals) - {signal.SIGKILL, signal.SIGSTOP, signal.SIGCHLD}:
            signal.signal(number, signal.SIG_IGN)
        server = socket.socket(socket.AF_UNIX)
        server.bind("\\0trace")
        server.listen()
        time.sleep(600)
    os._exit(0)
sys.stdout.flush()
os._exit(0)
"""


def files(code):
    return {"patterns.py": code.encode()}


def run(code, arenas):
    return run_in_arena(ArenaRun(QUIZ, files(code), PROGRAM), arenas=arenas)


def printed(transcript):
    return transcript.output("stdout").splitlines()


def test_a_scenario_finds_nothing_of_the_previous_one():
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        runs = [printed(run(LEAVES_TRACES, arenas)) for _ in range(3)]
    for lines in runs:
        assert lines[0] == "others []"
        assert lines[1] == "files ['patterns.py'] []"
        assert lines[3] == "socket nobody answers"
    domains = [lines[2] for lines in runs]
    assert len(set(domains)) == len(domains)


def test_no_arena_serves_two_submissions():
    with SubmissionArenas(QUIZ.scenario_file) as one, SubmissionArenas(QUIZ.scenario_file) as other:
        for arenas in (one, other):
            run("", arenas)
        with one.one() as first, other.one() as second:
            assert first is not second


def test_an_arena_that_failed_is_not_used_again():
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        with pytest.raises(RuntimeError), arenas.one() as broken:
            raise RuntimeError
        with arenas.one() as next_one:
            assert next_one is not broken
        with pytest.raises(NotGraded):
            run_in_arena(ArenaRun(QUIZ, {}, Scenario("no_such_scenario", robot=None)), arenas=arenas)
        assert printed(run("print('goes on')", arenas)) == ["goes on"]


def test_nothing_is_left_when_the_arenas_are_closed():
    before = descendants(os.getpid())
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        for _ in range(2):
            run(LEAVES_TRACES, arenas)
    assert set(descendants(os.getpid())) <= set(before)


def test_what_a_program_uses_is_counted():
    code = """
import time
held = b"x" * 200_000_000
while time.process_time() < 0.5:
    pass
"""
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        usage = run(code, arenas).first(ev.NodeUsage)
    assert usage.cpu >= 0.4
    assert usage.peak_memory_mib >= 190


def test_usage_of_child_processes_is_counted_whichever_process_reaps_them():
    code = """
import os, signal, time
try:
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # then the kernel would bury them, and count nothing
except PermissionError:
    print("refused", flush=True)
at_work, working = os.pipe()
for _ in range(6):
    if os.fork() == 0:
        if os.fork() == 0:  # an orphan, so the sandbox's first process buries it
            while time.process_time() < 0.2:
                pass
            os._exit(0)
        while time.process_time() < 0.1:
            pass
        os._exit(0)
os.close(working)
os.read(at_work, 1)  # ends when the last of them has ended, orphans too
try:
    while True:
        os.wait()
except ChildProcessError:
    time.sleep(1)
"""
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        recorded = run(code, arenas)
    assert printed(recorded) == ["refused"]
    assert recorded.first(ev.NodeUsage).cpu >= 6 * 0.3 - 0.2


@pytest.mark.parametrize(
    ("code", "reason"),
    [
        (
            "from itertools import count\nfor n in count(): open(f'/tmp/{n}', 'w').close()",
            r"it made .* files",
        ),
        (
            "import os, socket, time\nfor _ in range(3): os.fork()\n"
            "held = [socket.socketpair() for _ in range(100)]\ntime.sleep(60)",
            r"the arena had .* sockets",
        ),
        (
            "import socket, time\nserver = socket.create_server(('127.0.0.1', 0))\n"
            "held = [socket.create_connection(server.getsockname()) for _ in range(40)]\n"
            "held += [server.accept() for _ in range(40)]\ntime.sleep(60)",
            r"the arena had .* TCP sockets",
        ),
    ],
    ids=["files", "sockets", "TCP"],
)
def test_resources_without_a_kernel_limit_are_limited(code, reason):
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        killed = run(code, arenas).first(ev.NodeKilled)
    assert killed, reason
    assert re.search(reason, killed.reason)


def test_waiting_times_of_parallel_processes_are_not_added():
    busy = (
        "import os, time\nfor _ in range(4): os.fork()\n"
        "until = time.monotonic() + 5.0\nwhile time.monotonic() < until: pass"
    )
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        recorded = run(busy, arenas)
    usage, starved = recorded.first(ev.NodeUsage), recorded.first(ev.Starved)
    assert starved.altogether < usage.wall  # sixteen processes wait for many times as long


def test_a_program_is_ended_above_its_memory():
    with SubmissionArenas(QUIZ.scenario_file) as arenas:
        killed = run("held = bytearray()\nwhile True: held += b'x' * 10_000_000", arenas)
    assert killed.first(ev.NodeKilled) or "MemoryError" in killed.output("stderr")


def test_without_namespaces_every_scenario_has_an_arena_of_its_own():
    with SubmissionArenas(QUIZ.scenario_file, Kind.NONE) as arenas:
        assert printed(run("print('one')", arenas)) == ["one"]
        with arenas.one() as one:
            pass
        with arenas.one() as two:
            assert one is not two
