"""What a node printed and where its threads wait are read from its process, which goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from lab.client.waiting import becomes_true
from lab.running.node_diagnosis import how_it_ended, own_output, why_silent
from lab.running.processes import Process
from lab.running.student_nodes import StudentNode

BLOCKED = """
import threading, time
def on_request():
    print("up", flush=True)
    time.sleep(60)
threading.Thread(target=on_request, daemon=True).start()
def main():
    while True:
        time.sleep(1)
main()
"""
RAISES = """
import json
def on_request():
    json.loads("no")
on_request()
"""


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[[str], StudentNode]]:
    """Start a program of a student; it is killed at the end."""
    started: list[StudentNode] = []

    def start(program: str) -> StudentNode:
        file = tmp_path / "status.py"
        file.write_text(program, encoding="utf-8")
        started.append(StudentNode(file, Process([str(file)])))
        return started[-1]

    yield start
    for node in started:
        node.kill()


def test_the_line_in_which_a_callback_waits_is_quoted_and_the_program_goes_on(
    start: Callable[[str], StudentNode],
) -> None:
    node = start(BLOCKED)
    assert becomes_true(lambda: "up" in node.log(), 10.0)
    for _ in range(2):
        assert why_silent(node).startswith(
            "It was blocked in line 5 of status.py (`time.sleep(60)`), in on_request()."
        )
    assert node.is_running
    assert node.log() == "up\n"


def test_an_exception_is_named_with_the_students_line_and_without_those_of_libraries(
    start: Callable[[str], StudentNode],
) -> None:
    node = start(RAISES)
    assert becomes_true(lambda: not node.is_running, 10.0)
    assert how_it_ended(node).startswith("with exit status 1: json.decoder.JSONDecodeError: Expecting value")
    assert how_it_ended(node).endswith(
        'It was raised in line 4 of status.py (`json.loads("no")`), in on_request().'
    )
    assert 'File "status.py", line 4, in on_request' in own_output(node)
    assert "decoder.py" not in own_output(node)
