"""Tests from inside the sandbox what a hostile program cannot do."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import arenas
import pyseccomp
import pytest
from arenas import PACKAGE, Student, run_student

import ros_runtime
from autograder.isolation.arena_process import ArenaProcess, Ended, Kind
from autograder.isolation.limits import ArenaLimits

REPOSITORY = Path(__file__).parents[3]


def test_it_sees_no_file_of_the_host_and_nothing_of_the_grader(namespaces: Kind, tmp_path: Path) -> None:
    (tmp_path / "shown").write_text("x")
    (tmp_path / "hidden").write_text("x")
    looked_for = [
        *(str(REPOSITORY / name) for name in ("solutions", "tests", "autograder", "robot_sim", ".git")),
        *(str(tmp_path / name) for name in ("shown", "hidden")),
        *("/run/course", "/etc/shadow", "/var", "/home", f"{Path.home()}/.cache", "/sys"),
    ]
    code = f"import json, os; print(json.dumps([path for path in {looked_for} if os.path.exists(path)]))"
    run = run_student(Student(code, paths=[str(tmp_path / "shown")]), namespaces)
    assert run.json() == [str(tmp_path / "shown")]


def test_it_sees_its_own_processes_only_and_nothing_of_the_sandboxs_first(namespaces: Kind) -> None:
    code = """
import json, os
pids = [int(name) for name in os.listdir("/proc") if name.isdigit()]
print(json.dumps([len(pids), os.getpid(), os.getppid(), os.listdir("/proc/1")]))
"""
    count, pid, parent, known = run_student(Student(code), namespaces).json()
    assert (count, pid, parent) == (2, 2, 1)
    assert known == []  # neither its command line, which contains paths of the host, nor its memory


def test_memory_outside_of_the_measured_size_cannot_be_allocated(namespaces: Kind) -> None:
    code = """
import errno, json, mmap, os
refused = []
for descriptor in (-1, os.open("/dev/zero", os.O_RDWR)):
    try:
        mmap.mmap(descriptor, 4096)
    except OSError as error:
        refused.append(errno.errorcode[error.errno])
print(json.dumps([refused, open("/dev/zero", "rb").read(3).hex()]))
"""
    assert run_student(Student(code), namespaces).json() == [["ENOMEM", "ENODEV"], "000000"]


def test_it_inherits_no_open_file(namespaces: Kind) -> None:
    run = run_student(Student("import os; print(sorted(map(int, os.listdir('/proc/self/fd'))))"), namespaces)
    assert run.stdout == "[0, 1, 2, 3]\n"  # 3 is the listing itself


def test_it_shares_the_arenas_lo_and_no_other_network(namespaces: Kind) -> None:
    code = """
import json, socket
print([name for _, name in socket.if_nameindex()])
port = int(input())
with socket.create_connection(("127.0.0.1", port), 5) as line:
    print(line.recv(5).decode())
try:
    socket.create_connection(("8.8.8.8", 53), 5)
except OSError as error:
    print(error.strerror)
"""
    meanwhile = """
import socket
with socket.create_server(("127.0.0.1", 0)) as server:
    student.write_line(str(server.getsockname()[1]))
    server.settimeout(10)
    server.accept()[0].sendall(b"hello")
"""
    run = run_student(Student(code, meanwhile), namespaces)
    assert run.stdout == "['lo']\nhello\nNetwork is unreachable\n"


def test_system_calls_that_it_does_not_need_are_refused(namespaces: Kind) -> None:
    code = """
import ctypes, errno, json, os, socket
libc = ctypes.CDLL(None, use_errno=True)
def refused(call, *arguments):
    ctypes.set_errno(0)
    return call(*arguments) == -1 and errno.errorcode[ctypes.get_errno()]
def refused_family(family):
    try:
        socket.socket(family, socket.SOCK_STREAM)
    except OSError as error:
        return errno.errorcode[error.errno]
print(json.dumps({
    "ptrace": refused(libc.ptrace, 16, 1, None, None),
    "keyctl": refused(libc.syscall, 250, 0, -3, 0),
    "unshare": refused(libc.unshare, 0x10000000),
    "setns": refused(libc.setns, 0, 0),
    "mount": refused(libc.mount, b"none", b"/tmp", b"tmpfs", 0, None),
    "umount": refused(libc.umount2, b"/tmp", 2),
    "memfd": refused(libc.memfd_create, b"x", 0),
    "io_uring": refused(libc.syscall, 425, 1, None),
    "clone3": refused(libc.syscall, 435, None, 0),
    "vsock": refused_family(40),
    "packet": refused_family(17),
}))
"""
    seen = run_student(Student(code), namespaces).json()
    assert seen.pop("clone3") == "ENOSYS"
    assert set(seen.values()) == {"EPERM"}, seen


def test_it_finds_nothing_to_signal_but_itself(namespaces: Kind) -> None:
    code = """
import os, signal
os.kill(1, signal.SIGKILL)  # the kernel protects the init of a namespace
try:
    os.kill(-1, signal.SIGKILL)
except ProcessLookupError:
    print("alone")
"""
    assert run_student(Student(code), namespaces).stdout == "alone\n"


def test_it_can_write_in_its_folder_and_tmp_only(namespaces: Kind, tmp_path: Path) -> None:
    (tmp_path / "shown").mkdir()
    places = [
        "/tmp",
        "/tmp/work",
        "/dev/shm",
        "/",
        "/usr",
        "/etc",
        "/dev",
        "/proc",
        sys.prefix,
        str(tmp_path / "shown"),
    ]
    code = f"""
import json
writable = []
for place in {places}:
    try:
        open(place + "/mine", "w").close()
        writable.append(place)
    except OSError:
        pass
print(json.dumps(writable))
"""
    run = run_student(Student(code, paths=[str(tmp_path / "shown")]), namespaces)
    assert run.json() == ["/tmp", "/tmp/work", "/dev/shm"]
    assert not list((tmp_path / "shown").iterdir())


def test_it_can_fill_only_its_share_of_the_disk(namespaces: Kind) -> None:
    code = """
import errno, json
def fill(folder):
    written = 0
    for number in range(100):
        with open(f"{folder}/{number}", "wb", buffering=0) as file:
            try:
                while True: written += file.write(bytes(1 << 20))
            except OSError as error:
                if error.errno == errno.ENOSPC:
                    return written >> 20, number
                assert error.errno == errno.EFBIG, error
print(json.dumps([fill("/tmp"), fill("/dev/shm")]))
"""
    limits = {"tmp_mib": 12, "shared_memory_mib": 4, "file_mib": 5}
    (in_tmp, files), (in_shared_memory, _) = run_student(Student(code, limits=limits), namespaces).json()
    assert in_tmp <= 12
    assert files == 2  # two files of 5 MiB and what is left
    assert in_shared_memory <= 4


def test_a_fork_bomb_is_bounded_and_the_arena_continues(namespaces: Kind) -> None:
    code = """
import os, time
children = 0
try:
    for _ in range(1000):
        if os.fork() == 0:
            time.sleep(60)
        children += 1
except BlockingIOError:
    print("stopped at", children)
"""
    run = run_student(Student(code, limits={"processes": 20}), namespaces)
    assert run.returncode == 0
    assert 10 < int(run.stdout.split()[-1]) < 20
    assert run.report.nothing_survives


def test_a_fork_bomb_that_goes_on_is_ended_at_the_deadline(namespaces: Kind) -> None:
    code = """
import os
while True:
    try:
        os.fork()
    except OSError:
        pass
"""
    spec = Student(code).spec(ArenaLimits(deadline_s=1.0))
    report = ArenaProcess(spec, namespaces).wait(30)
    assert report.ended is Ended.DEADLINE
    assert report.nothing_survives


def test_one_process_cannot_ask_for_more_address_space_than_allowed(kind: Kind) -> None:
    code = "try: bytearray(600 << 20)\nexcept MemoryError: print('no')"
    assert run_student(Student(code, limits={"address_space_mib": 500}), kind).stdout == "no\n"


def test_a_memory_bomb_ends_the_arena_and_names_the_cause(namespaces: Kind) -> None:
    code = "import os\nos.fork()\nhog = []\nwhile True: hog.append(bytearray(b'x') * (4 << 20))"
    spec = Student(code).spec(ArenaLimits(deadline_s=30, memory_mib=300))
    report = ArenaProcess(spec, namespaces).wait(60)
    assert report.ended is Ended.MEMORY
    assert report.peak_memory_mib > 300
    assert report.nothing_survives


def test_an_endless_loop_ends_at_the_deadline(kind: Kind) -> None:
    spec = Student("while True: pass").spec(ArenaLimits(deadline_s=0.6))
    report = ArenaProcess(spec, kind).wait(30)
    assert report.ended is Ended.DEADLINE
    assert report.nothing_survives


@pytest.mark.skipif(os.geteuid() != 0, reason="these tests are already run by an ordinary user")
def test_an_ordinary_user_can_start_arenas_too(namespaces: Kind) -> None:
    """Arenas of root start in another way than those of other users."""
    python = "/usr/bin/python3"
    become = ["/usr/bin/setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--no-new-privs"]
    if not os.access(python, os.X_OK):
        pytest.skip(f"an ordinary user's Python is looked for in {python}")
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        shutil.copytree(PACKAGE, f"{folder}/autograder/isolation")
        shutil.copytree(Path(ros_runtime.__file__).parent, f"{folder}/ros_runtime")
        for file in (arenas.__file__, arenas.AGENT, pyseccomp.__file__):
            shutil.copy(file, folder)
        subprocess.run(["/bin/chmod", "-R", "a+rX", folder], check=True)
        done = subprocess.run(
            [*become, python, f"{folder}/arenas.py"],
            input="import os\nprint(os.getpid(), os.path.exists('/etc/shadow'))",
            env={"PYTHONPATH": folder},
            capture_output=True,
            text=True,
            check=False,
        )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == {"returncode": 0, "stdout": "2 False\n", "stderr": ""}
