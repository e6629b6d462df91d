"""The trusted process in an arena can run the program, read its output, send signals to it and end it."""

from __future__ import annotations

import re
import signal

import pytest
from arenas import Student, run_student

from autograder.isolation.arena_process import Kind
from autograder.isolation.student_sandbox import Program
from ros_runtime.workarounds.rclpy_repairs.hook import STACK_FILE


def test_a_program_runs_in_its_folder_and_its_output_is_read_by_line(kind: Kind) -> None:
    code = """
import sys
from helper import word
print(word, sys.argv[1:])
print("trouble", file=sys.stderr)
print(open("data/table.csv").read(), end="")
"""
    files = {"helper.py": "word = 'hello'", "data/table.csv": "1,2"}
    run = run_student(Student(code, arguments=["--ros-args"], files=files), kind)
    assert run.stdout == "hello ['--ros-args']\n1,2\n"
    assert run.stderr == "trouble\n"
    assert (run.returncode, run.codes) == (0, [0])
    assert {(stream, text) for _, stream, text in run.lines} == {
        ("stdout", "hello ['--ros-args']"),
        ("stdout", "1,2"),
        ("stderr", "trouble"),
    }


def test_lines_carry_the_time_at_which_they_were_printed(kind: Kind) -> None:
    code = "import time; print('first'); input(); print('second')"
    meanwhile = """
wait_for_line("first")
noted = time.monotonic()
student.write_line("go on")
wait_for_line("second")
lines.append([noted, "noted", ""])
"""
    run = run_student(Student(code, meanwhile), kind)
    times = {text or stream: t for t, stream, text in run.lines}
    assert times["first"] <= times["noted"] <= times["second"]


def test_it_gets_the_environment_it_was_given_and_the_arenas_network(kind: Kind) -> None:
    run = run_student(
        Student("import os, json; print(json.dumps(dict(os.environ)))", env={"GIVEN": "yes"}), kind
    )
    seen = run.json()
    assert seen["GIVEN"] == "yes"
    network = "FASTDDS_BUILTIN_TRANSPORTS" if kind is Kind.NAMESPACES else "ROS_DOMAIN_ID"
    assert network in seen
    assert "COURSE_ISOLATION" not in seen


@pytest.mark.parametrize(
    ("code", "returncode"),
    [
        ("raise SystemExit(3)", 3),
        ("1 / 0", 1),
        ("import os; os.kill(os.getpid(), 9)", -signal.SIGKILL),
        ("import os; os.abort()", -signal.SIGABRT),
    ],
)
def test_its_exit_status_is_reported(kind: Kind, code: str, returncode: int) -> None:
    assert run_student(Student(code), kind).returncode == returncode


WAITS = """
import threading
def wait():
    print("waiting", flush=True)
    threading.Event().wait(0.5)
    print("went on", flush=True)
wait()
"""


def test_a_program_prints_the_stacks_of_its_threads_and_goes_on(kind: Kind) -> None:
    meanwhile = "wait_for_line('waiting'); student.print_stacks(); wait_for_line('went on')"
    run = run_student(Student(WAITS, meanwhile, env={STACK_FILE: "2"}), kind)
    assert re.search(r'node\.py", line \d in wait\n', run.stderr)
    assert (run.stdout, run.returncode) == ("waiting\nwent on\n", 0)


def test_an_aborted_program_prints_the_stacks_of_its_threads(kind: Kind) -> None:
    code = """
import threading
def wait():
    print("waiting", flush=True)
    threading.Event().wait()
wait()
"""
    meanwhile = "wait_for_line('waiting'); student.abort()"
    run = run_student(Student(code, meanwhile, env={"PYTHONFAULTHANDLER": "1"}), kind)
    assert run.returncode == -signal.SIGABRT
    assert re.search(r'node\.py", line \d in wait\n', run.stderr)


def test_an_interrupt_reaches_its_process_group_as_in_a_terminal(kind: Kind) -> None:
    code = """
import subprocess, sys, time
child = subprocess.Popen(["/bin/sleep", "60"])
elsewhere = subprocess.Popen(["/bin/sleep", "60"], start_new_session=True)
try:
    print("ready")
    time.sleep(60)
except KeyboardInterrupt:
    print("interrupted, child", child.wait(), "elsewhere", elsewhere.poll())
    elsewhere.kill()
    sys.exit(5)
"""
    run = run_student(Student(code, "wait_for_line('ready'); student.interrupt()"), kind)
    assert run.stdout == "ready\ninterrupted, child -2 elsewhere None\n"
    assert run.returncode == 5


def test_an_interrupt_without_a_handler_ends_it(kind: Kind) -> None:
    code = "import time\nprint('ready')\ntime.sleep(60)"
    run = run_student(Student(code, "wait_for_line('ready'); student.interrupt()"), kind)
    assert run.returncode == -signal.SIGINT
    assert "KeyboardInterrupt" in run.stderr


@pytest.mark.parametrize(
    ("verb", "number"), [("terminate", signal.SIGTERM), ("kill", signal.SIGKILL)], ids=["terminate", "kill"]
)
def test_it_can_be_ended(kind: Kind, verb: str, number: int) -> None:
    run = run_student(
        Student("print('ready')\nwhile True: pass", f"wait_for_line('ready'); student.{verb}()"), kind
    )
    assert run.returncode == -number


def test_a_program_that_ignores_every_signal_can_be_ended(kind: Kind) -> None:
    code = """
import signal
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, signal.SIG_IGN)
print("ready")
while True: signal.pause()
"""
    meanwhile = """
wait_for_line("ready")
student.interrupt(); student.terminate()
assert student.wait(0.2) is None and student.returncode is None
student.kill()
student.kill(); student.interrupt(); student.write_line("too late")
"""
    assert run_student(Student(code, meanwhile), kind).returncode == -signal.SIGKILL


def test_a_program_reads_lines_from_stdin(kind: Kind) -> None:
    code = "import sys\nfor line in sys.stdin: print('read', line.strip())\nprint('end')"
    meanwhile = "student.write_line('q'); wait_for_line('read q'); student.close_stdin()"
    run = run_student(Student(code, meanwhile), kind)
    assert run.stdout == "read q\nend\n"


def test_a_flood_of_output_is_cut_and_noted(kind: Kind) -> None:
    code = "import sys\nfor _ in range(3000): sys.stdout.write('flood ' * 300 + '\\n')\nprint('a line')"
    run = run_student(Student(code, limits={"output_kib": 8}), kind)
    assert run.returncode == 0
    assert len(run.stdout) < 16_000
    assert run.stdout.splitlines()[-1].startswith("[cut after 8 KiB of output;")


def test_an_endless_line_is_kept_in_pieces(kind: Kind) -> None:
    run = run_student(Student("print('x' * 10_000, end='')"), kind)
    assert [len(text) for _, _, text in run.lines] == [4096, 4096, 1808]


def test_nothing_it_started_outlives_it(namespaces: Kind) -> None:
    """The daemon closes inherited files and leaves its session; at the end the trusted process has no children."""
    code = """
import os, signal
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        print("daemon")
        os.closerange(0, 3)
        while True: signal.pause()
    os._exit(0)
os.wait()
print("alone")
input()
"""
    meanwhile = """
from autograder.isolation.process_tree import descendants
wait_for_line("daemon")
wait_for_line("alone")
assert len(descendants(os.getpid())) == 4, descendants(os.getpid())  # bwrap twice, the program, the daemon
student.write_line("end")
assert student.wait(10) == 0
assert student.returncode == 0 and not descendants(os.getpid())
"""
    run_student(Student(code, meanwhile), namespaces)


def test_several_can_run_one_after_another(kind: Kind) -> None:
    code = "import os\nprint(os.path.exists('mark'))\nopen('mark', 'w')"
    run = run_student(Student(code, "student.wait(); student = start()"), kind)
    assert [text for _, _, text in run.lines] == ["False", "False"]
    assert run.codes == [0, 0]


@pytest.mark.parametrize("name", ["/etc/passwd", "../escaped.py", "a/../../b"])
def test_a_file_name_that_leaves_the_folder_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match="leads out of the working directory"):
        Program(["node.py"], {name: b""})
