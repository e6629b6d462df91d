"""An arena runs its command, is limited, and leaves nothing behind; the controller relies on this."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from arenas import ENVIRONMENT

from autograder.isolation.arena_process import ArenaProcess, ArenaReport, ArenaSpec, Ended, Kind
from autograder.isolation.bubblewrap import SandboxError
from autograder.isolation.limits import ArenaLimits
from autograder.isolation.memory_group import make_memory_group
from autograder.isolation.python_paths import python_read_only_paths
from leftovers import group_folders

REPOSITORY = Path(__file__).parents[3]


def run_shell(script: str, kind: Kind, limits: ArenaLimits | None = None, **spec) -> ArenaReport:
    return ArenaProcess(
        ArenaSpec(["/bin/sh", "-c", script], limits=limits or ArenaLimits(30), **spec), kind
    ).wait(60)


def run_python(code: str, kind: Kind, limits: ArenaLimits | None = None, **spec) -> ArenaReport:
    command = [sys.executable, "-c", code]
    spec = ArenaSpec(
        command, python_read_only_paths(), env=ENVIRONMENT, limits=limits or ArenaLimits(30), **spec
    )
    return ArenaProcess(spec, kind).wait(60)


def test_the_command_reads_its_input_and_its_output_and_status_come_back(kind: Kind) -> None:
    report = run_shell("read word; echo got $word; echo trouble >&2; exit 7", kind, stdin=b"hello\n")
    assert (report.stdout.text, report.stderr.text) == ("got hello\n", "trouble\n")
    assert (report.ended, report.exit_code) == (Ended.EXIT, 7)
    assert report.nothing_survives


def test_a_pipe_of_the_caller_reaches_into_the_arena(kind: Kind) -> None:
    read, write = os.pipe()
    command = [sys.executable, "-c", f"import os; os.write({write}, b'event')"]
    arena = ArenaProcess(
        ArenaSpec(command, python_read_only_paths(), env=ENVIRONMENT, pass_fds=[write]), kind
    )
    os.close(write)
    with os.fdopen(read) as events:
        assert events.read() == "event"
    assert arena.wait(30).exit_code == 0


def test_the_environment_is_what_the_caller_gave(kind: Kind, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SECRET_TOKEN", "of the host")
    report = run_shell("env", kind, env={"GIVEN": "yes"})
    assert "GIVEN=yes" in report.stdout.text.splitlines()
    assert "SECRET_TOKEN" not in report.stdout.text


def test_the_deadline_ends_an_arena_that_does_nothing(kind: Kind) -> None:
    report = run_shell("sleep 1000", kind, ArenaLimits(deadline_s=0.3))
    assert report.ended is Ended.DEADLINE
    assert report.nothing_survives
    assert report.seconds < 10


def test_an_arena_that_takes_too_much_memory_is_ended_and_says_so(kind: Kind) -> None:
    # four processes together exceed the limit, none of them alone
    hog = "import os; os.fork(); os.fork(); hog = bytearray(os.urandom(1)) * (60 << 20); import time; time.sleep(60)"
    limits = ArenaLimits(deadline_s=30, memory_mib=160)
    report = run_python(hog, kind, limits)
    assert report.ended is Ended.MEMORY
    assert report.peak_memory_mib > 160
    assert "may use 160 MiB" in report.explain(limits)
    assert report.nothing_survives


def test_memory_within_the_limit_is_measured_and_allowed(kind: Kind) -> None:
    code = "import time; hog = bytearray(b'x') * (80 << 20); time.sleep(0.5)"  # for ten samples
    report = run_python(code, kind, ArenaLimits(30, memory_mib=400))
    assert (report.ended, report.exit_code) == (Ended.EXIT, 0)
    assert 80 < report.peak_memory_mib < 400


def test_memory_that_no_process_has_resident_is_counted_by_the_kernel(namespaces: Kind) -> None:
    """Files in memory that no process maps; together they exceed the arena's limit for a moment."""
    group = make_memory_group(64)
    if group is None:
        pytest.skip("only root can make control groups of memory, where the kernel has them")
    group.remove()
    hog = "import os, time\nfor _ in range(40): os.write(os.memfd_create('hog'), bytes(16 << 20))\ntime.sleep(60)"
    limits = ArenaLimits(deadline_s=30, memory_mib=100)
    report = run_python(hog, namespaces, limits)
    assert report.ended is Ended.MEMORY
    assert "may use 100 MiB" in report.explain(limits)
    assert report.nothing_survives
    assert group_folders() == []


def test_a_caller_can_end_an_arena(kind: Kind) -> None:
    arena = ArenaProcess(ArenaSpec(["/bin/sleep", "1000"], limits=ArenaLimits(60)), kind)
    assert arena.poll() is None
    report = arena.kill()
    assert report.ended is Ended.KILLED
    assert report.nothing_survives
    assert arena.poll() is report


def test_a_command_killed_by_a_signal_has_the_exit_status_of_a_shell(kind: Kind) -> None:
    assert run_shell("kill -KILL $$", kind).exit_code == 128 + signal.SIGKILL


def test_output_is_kept_up_to_the_limit_only(kind: Kind) -> None:
    report = run_shell("yes flood | head -c 3000000", kind, ArenaLimits(30, output_kib=16))
    assert len(report.stdout.text) < 20_000
    assert report.stdout.lines[-1].text.startswith("[cut after 16 KiB of output;")
    assert report.exit_code == 0


@pytest.mark.parametrize("end", ["exit", "kill"])
def test_a_daemon_does_not_outlive_the_arena(kind: Kind, end: str) -> None:
    """The daemon has a new session and parent and ignores signals; only its end closes the pipe.

    The program does not exit before the daemon has written to the pipe.
    """
    read, write = os.pipe()
    daemon = f"""
import os, signal, sys
for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
    signal.signal(number, signal.SIG_IGN)
wait_for, written = os.pipe()
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        os.close(0); os.close(1); os.close(2)
        os.write({write}, b"daemon")
        os.write(written, b"!")
        while True: signal.pause()
    os.read(wait_for, 1)
    os._exit(0)
os.wait()
if {end == "kill"}: signal.pause()
"""
    spec = ArenaSpec(
        [sys.executable, "-c", daemon],
        python_read_only_paths(),
        env=ENVIRONMENT,
        pass_fds=[write],
        limits=ArenaLimits(30),
    )
    arena = ArenaProcess(spec, kind)
    os.close(write)
    with os.fdopen(read, "rb", buffering=0) as pipe:
        assert pipe.read(6) == b"daemon"
        report = arena.kill() if end == "kill" else arena.wait(30)
        assert pipe.read(1) == b""
    assert report.nothing_survives


def test_an_arena_ends_with_its_controller(kind: Kind, tmp_path: Path) -> None:
    """The arena ends even if the controller is killed: only the arena's end closes the pipe."""
    read, write = os.pipe()
    controller = f"""
from autograder.isolation.arena_process import ArenaSpec, Kind, ArenaProcess
ArenaProcess(ArenaSpec(["/bin/sh", "-c", "sleep 1000 & sleep 1000"], pass_fds=[{write}]), Kind({kind.value!r}))
print("started", flush=True)
import signal
signal.pause()
"""
    command = [sys.executable, "-c", controller]
    env = {**os.environ, **ENVIRONMENT, "TMPDIR": str(tmp_path)}  # nobody is left to clean up
    with subprocess.Popen(command, stdout=subprocess.PIPE, pass_fds=[write], text=True, env=env) as process:
        os.close(write)
        assert process.stdout
        assert process.stdout.readline() == "started\n"
        process.kill()
    with os.fdopen(read, "rb") as pipe:
        assert pipe.read() == b""


def test_an_arena_lives_on_when_the_thread_that_started_it_ends(kind: Kind) -> None:
    with ThreadPoolExecutor(1) as pool:
        arena = pool.submit(
            ArenaProcess, ArenaSpec(["/bin/sh", "-c", "sleep 0.2; echo alive"]), kind
        ).result()
    assert arena.wait(30).stdout.text == "alive\n"


def test_parallel_arenas_are_separate(kind: Kind) -> None:
    arenas = [ArenaProcess(ArenaSpec(["/bin/echo", str(number)]), kind) for number in range(4)]
    assert [arena.wait(30).stdout.text for arena in arenas] == ["0\n", "1\n", "2\n", "3\n"]


def test_an_arena_sees_the_paths_it_was_given_and_nothing_else_of_the_host(
    namespaces: Kind, tmp_path: Path
) -> None:
    (tmp_path / "shown").mkdir()
    (tmp_path / "shown" / "note").write_text("read me")
    (tmp_path / "hidden").write_text("secret")
    home = f"{Path.home()}/.profile {Path.home()}/.cache"
    project = f"{REPOSITORY}/tests {REPOSITORY}/pyproject.toml"
    script = f"""
cat {tmp_path}/shown/note; echo
for path in {tmp_path}/hidden {project} {home} /etc/shadow /var; do
    [ -e $path ] && echo sees $path
done
for path in {tmp_path}/shown/note {tmp_path}/shown/more /usr/more /etc/more /dev/more /more; do
    (echo x > $path) 2>/dev/null && echo writes $path
done
echo x > /tmp/mine && cat /tmp/mine
"""
    report = run_shell(script, namespaces, read_only_paths=[tmp_path / "shown"])
    assert report.stdout.text == "read me\nx\n"
    assert (tmp_path / "shown" / "note").read_text() == "read me"


def test_an_arena_has_a_network_of_its_own_with_lo_only(namespaces: Kind) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        code = f"""
import socket
print([name for _, name in socket.if_nameindex()])
try:
    socket.create_connection(("127.0.0.1", {port}), 5)
except ConnectionRefusedError:
    print("refused")
"""
        assert run_python(code, namespaces).stdout.text == "['lo']\nrefused\n"


def test_an_arena_sees_no_process_of_the_host(namespaces: Kind) -> None:
    report = run_shell(
        "for p in /proc/[0-9]*; do echo ${p#/proc/}; done | wc -l; cat /proc/1/cmdline", namespaces
    )
    count, command = report.stdout.text.splitlines()
    assert int(count) <= 4
    assert str(REPOSITORY) not in command


def test_a_mapped_file_is_shared_with_the_arena_while_it_runs(kind: Kind, tmp_path: Path) -> None:
    page = tmp_path / "page"
    page.write_bytes(b"a")
    page.chmod(0o600)
    read, write = os.pipe()
    back, forth = os.pipe()
    code = (
        f"import os; page = open({str(page)!r}, 'rb', buffering=0); print(page.read()); os.write({write}, b'.');"
        f"os.read({back}, 1); page.seek(0); print(page.read())"
    )
    spec = ArenaSpec(
        [sys.executable, "-c", code],
        [*python_read_only_paths(), page],
        env=ENVIRONMENT,
        pass_fds=[write, back],
        limits=ArenaLimits(30),
    )
    arena = ArenaProcess(spec, kind)
    os.close(write)
    assert os.read(read, 1) == b"."
    page.write_bytes(b"b")
    os.write(forth, b".")
    assert arena.wait(30).stdout.text == "b'a'\nb'b'\n"
    for fd in (read, back, forth):
        os.close(fd)


def test_folders_that_only_their_owner_can_read_are_shown_all_the_same(
    namespaces: Kind, tmp_path: Path
) -> None:
    """As with a clone of umask 077 in a home of mode 0700: for root, the arena has another user."""
    folder = tmp_path / "home" / "clone"
    folder.mkdir(parents=True)
    (folder / "module.py").write_text("answer = 42")
    (folder / "module.py").chmod(0o600)
    folder.chmod(0o700)
    folder.parent.chmod(0o700)
    report = run_shell(f"cat {folder}/module.py", namespaces, read_only_paths=[folder])
    assert report.stdout.text == "answer = 42\n", report.stderr.text
    assert folder.stat().st_mode & 0o777 == 0o700


def test_a_path_that_does_not_exist_is_refused(namespaces: Kind, tmp_path: Path) -> None:
    with pytest.raises(SandboxError, match="missing is to be shown in a sandbox, but it does not exist"):
        ArenaProcess(ArenaSpec(["/bin/true"], [tmp_path / "missing"]), namespaces)


def test_a_command_that_does_not_exist_ends_the_arena_with_a_reason(kind: Kind) -> None:
    report = ArenaProcess(ArenaSpec(["/usr/bin/no-such-program"], limits=ArenaLimits(30)), kind).wait(30)
    assert report.exit_code != 0
    assert "no-such-program" in report.stderr.text
