"""Two students use a read-only installation at the same time: each has a robot and discovers no other."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from shlex import quote

import pytest

from ros_runtime.project import PROJECT

pytestmark = pytest.mark.skipif(os.geteuid() != 0, reason="only root can be two other users")
STUDENTS = {61001: 1, 61002: -1}  # user id: which way the robot walks
SESSION = """
import sys
import lab
way = int(sys.argv[1])
lab.start_robot()
print("up", flush=True)
input()  # both robots are up
with lab.walking(forward=0.25 * way):
    lab.wait_until(lambda: way * lab.pose().x > 0.3, timeout=60)
nodes = lab.node().get_node_names_and_namespaces()
print("robots", sum(name == "humanoid" for name, _ in nodes), "notebooks", sum(name == "notebook" for name, _ in nodes))
print("x", lab.pose().x, flush=True)
input()  # both have walked
"""


def as_student(user: int, home: Path, *command: str) -> list[str]:
    """A command that runs as a user for whom the project and its Python are read-only, whoever owns them."""
    shared = [PROJECT, Path(sys.base_prefix)]
    lines = ["set -e", "kept=$(mktemp -d)", "mount -t tmpfs none $kept"]
    for number, path in enumerate(shared):
        lines += [f"mkdir $kept/{number}", f"mount --bind {quote(str(path))} $kept/{number}"]
    # For files in a folder that only root may enter: make the path to them visible, and nothing else in that folder.
    locked = {folder for path in shared for folder in path.parents if not folder.stat().st_mode & 0o001}
    outermost = [folder for folder in locked if locked.isdisjoint(folder.parents)]
    lines += [f"mount -t tmpfs -o mode=755 none {quote(str(folder))}" for folder in outermost]
    for number, path in enumerate(shared):
        place = quote(str(path))
        lines += [
            f"mkdir -p {place}",
            f"mount --bind $kept/{number} {place}",
            f"mount -o remount,bind,ro {place}",
        ]
    lines += ["umount -R $kept", "rmdir $kept", f"cd {quote(str(home))}"]
    step_down = ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", "--no-new-privs"]
    lines += [f"exec {shlex.join([*step_down, 'env', f'HOME={home}', *command])}"]
    return ["unshare", "--mount", "sh", "-c", "\n".join(lines)]


@pytest.fixture
def homes(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[int, Path]]:
    homes = {}
    with_room = subprocess.run(["mktemp", "-d"], capture_output=True, text=True, check=True).stdout.strip()
    Path(with_room).chmod(0o755)
    for user in STUDENTS:
        homes[user] = Path(with_room, str(user))
        homes[user].mkdir(mode=0o700)
        os.chown(homes[user], user, user)
    yield homes
    subprocess.run(["rm", "-rf", with_room], check=True)


def line_with(process: subprocess.Popen[str], word: str) -> list[str]:
    """The words of the next line that begins with a word; an AssertionError with the whole output if there is none."""
    printed = []
    assert process.stdout
    for line in process.stdout:
        printed.append(line)
        if line.split()[:1] == [word]:
            return line.split()
    raise AssertionError("".join(printed))


def test_each_student_walks_a_robot_and_discovers_no_other(homes: dict[int, Path]) -> None:
    sessions = {}
    for user, way in STUDENTS.items():
        python = str(PROJECT / ".venv/bin/python")
        sessions[user] = subprocess.Popen(
            as_student(user, homes[user], python, "-c", SESSION, str(way)),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
    try:
        for step in ("up", "walked"):
            lines = {}
            for user, session in sessions.items():
                lines[user] = line_with(session, "robots" if step == "walked" else "up")
                if step == "walked":
                    assert lines[user] == ["robots", "1", "notebooks", "1"]
                    assert STUDENTS[user] * float(line_with(session, "x")[1]) > 0.2
            for session in sessions.values():
                assert session.stdin
                session.stdin.write("\n")
                session.stdin.flush()
        assert [session.wait(timeout=30) for session in sessions.values()] == [0, 0]
    finally:
        for session in sessions.values():
            session.kill()
            session.communicate()


def test_the_launcher_gives_each_student_own_notebooks(homes: dict[int, Path]) -> None:
    for user, home in homes.items():
        started = subprocess.run(
            as_student(user, home, str(PROJECT / "course"), "lab", "--version"),
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )
        assert started.returncode == 0, started.stdout + started.stderr
        notebook = home / "humanoid_course/exercises/patterns/patterns.ipynb"
        assert notebook.stat().st_uid == user
        assert notebook.read_bytes() == (PROJECT / "exercises/patterns/patterns.ipynb").read_bytes()
