"""The console script `course`."""

from __future__ import annotations

import os
import pty
import re
import select
import signal
import socket
import subprocess
import sys
import time
from importlib.metadata import version
from inspect import isfunction
from itertools import pairwise
from pathlib import Path
from typing import get_type_hints
from urllib.error import URLError
from urllib.request import urlopen

import pytest
from typer.testing import CliRunner

from course_cli.app import COMMANDS, app, load

COURSE = Path(sys.executable).with_name("course")
TIMEOUT = 60.0  # s, for a busy machine


def course(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    variables = {**os.environ, **environment}
    return subprocess.run([COURSE, *arguments], capture_output=True, text=True, env=variables)


def test_help_lists_the_commands_that_exist_without_importing_them() -> None:
    code = (
        "import sys, course_cli.app\n"
        "try: course_cli.app.main(['--help'])\n"
        "finally: print([m for m in sys.modules if '.commands.' in m or m == 'rclpy'])"
    )
    finished = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)

    assert finished.returncode == 0
    assert "test" in finished.stdout
    assert finished.stdout.splitlines()[-1] == "[]"


def test_an_unknown_command_is_an_unusable_argument() -> None:
    finished = course("dance")

    assert finished.returncode == 2
    assert "dance" in finished.stderr


@pytest.mark.parametrize("name", ["lab", "ros", "sim", "test"])
def test_a_command_is_loaded_by_its_name(name: str) -> None:
    assert callable(load(name))


@pytest.mark.parametrize(("assertion", "status"), [("True", 0), ("False", 1)])
def test_the_test_command_has_pytests_exit_status(tmp_path: Path, assertion: str, status: int) -> None:
    test_file = tmp_path / "test_sample.py"
    test_file.write_text(f"def test_sample():\n    assert {assertion}\n")

    finished = course("test", str(test_file), "-q", "-n", "0", "-p", "no:cacheprovider")

    assert finished.returncode == status
    assert ("1 passed" if status == 0 else "1 failed") in finished.stdout.splitlines()[-1]


def test_the_robot_node_gets_its_own_arguments() -> None:
    finished = course("sim", "--scene", "moon")

    assert finished.returncode == 2
    assert "moon" in finished.stderr


def test_jupyterlab_gets_its_own_arguments() -> None:
    finished = course("lab", "--version")

    assert finished.returncode == 0
    assert finished.stdout.strip() == version("jupyterlab")


def test_the_help_of_the_lab_names_what_it_opens() -> None:
    finished = course("lab", "--help")

    assert finished.returncode == 0
    assert "chapters and exercises" in finished.stdout


@pytest.mark.parametrize("name", ["lab", "check", "submit", "replay"])
def test_the_help_has_whole_lines_and_no_names_of_python(name: str) -> None:
    shown = course(name, "--help", COLUMNS="80").stdout
    assert not re.search(r"<\w+|\w+\[str\]|\{", shown)
    above = shown.partition("╭")[0].splitlines()
    for line, following in pairwise(line.strip() for line in above):
        if line and following:
            assert len(line) + len(following.split()[0]) > 70, line


@pytest.mark.parametrize("words", [["check", "--help"], ["check"], ["--help"]], ids=" ".join)
def test_the_help_can_be_read_on_white_and_on_black(words: list[str]) -> None:
    finished = course(*words, COLUMNS="80", FORCE_COLOR="1", TERM="xterm")
    shown = finished.stdout + finished.stderr
    styles = {frozenset(codes.split(";")) for codes in re.findall(r"\x1b\[([\d;]+)m", shown)} - {
        frozenset({"0"})
    }
    assert {"1"} in styles
    dark_red, yellow, cyan, light = {"31"}, {"33", "93"}, {"36", "96"}, {"37", "97"}
    assert [style for style in styles if style & (yellow | cyan | light)] == []
    assert [style for style in styles if style & dark_red and "1" not in style] == []


def test_one_ctrl_c_ends_the_lab_and_says_what_has_ended() -> None:
    reader, writer = pty.openpty()
    port = ephemeral_port()
    command = [COURSE, "lab", "--no-browser", f"--port={port}"]
    lab = subprocess.Popen(command, stdin=writer, stdout=writer, stderr=writer, start_new_session=True)
    os.close(writer)
    try:
        printed = read_until(reader, "?token=")
        await_response(f"http://127.0.0.1:{port}/api")  # it prints the address before it listens there
        lab.send_signal(signal.SIGINT)
        printed += read_until(reader, "as last saved")
        assert lab.wait(TIMEOUT) == 0
        assert "(y/[n])" not in printed
    finally:
        lab.kill()
        lab.wait()
        os.close(reader)


def ephemeral_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


def await_response(address: str) -> None:
    """Wait until a server responds."""
    deadline = time.monotonic() + TIMEOUT
    while True:
        try:
            return urlopen(address, timeout=TIMEOUT).close()
        except URLError:
            assert time.monotonic() < deadline
            time.sleep(0.05)


def read_until(terminal: int, words: str) -> str:
    """What a program prints on a terminal until these words; fail if they do not come."""
    printed = ""
    deadline = time.monotonic() + TIMEOUT
    while words not in printed:
        assert select.select([terminal], [], [], max(0.0, deadline - time.monotonic()))[0], printed
        printed += os.read(terminal, 4096).decode(errors="replace")
    return printed


def test_the_help_shows_no_type_behind_a_flag() -> None:
    for name, flag in (("check", "--record"), ("replay", "--text"), ("grade", "--resume")):
        shown = CliRunner().invoke(app(name), [name, "--help"]).output
        assert flag in shown
        assert "bool" not in shown


def test_a_misspelled_exercise_gets_a_suggestion_and_any_other_name_the_list() -> None:
    assert "there is no exercise 'paterns'; did you mean patterns?" in course("check", "paterns").stdout
    assert "there are arm_architecture, " in course("check", "zzz").stdout


def test_what_is_to_be_written_takes_no_path_of_the_other_kind(tmp_path: Path) -> None:
    """A folder where a file is to be written, and the other way round, is refused before anything is done."""
    given = {
        f"{name} --{option}": info
        for name in COMMANDS
        if isfunction(load(name))
        for option, hint in get_type_hints(load(name), include_extras=True).items()
        for info in getattr(hint, "__metadata__", ())
        if option in ("out", "output", "json")
    }
    assert len(given) > 10
    assert [option for option, info in given.items() if info.file_okay is info.dir_okay] == []

    refused = course("release", "--out", str(tmp_path), COLUMNS="300")
    assert refused.returncode == 2
    assert f"'--out': file '{tmp_path}' is a directory" in refused.stderr
