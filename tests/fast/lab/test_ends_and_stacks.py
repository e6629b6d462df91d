"""What a node printed and where its threads wait are read from its process, which goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from autograder.engine.starter import given_in
from lab.client import topics
from lab.client.exchange import no_answer, wait_until
from lab.client.waiting import becomes_true
from lab.errors import NotInTimeError
from lab.running import node_diagnosis
from lab.running.node_diagnosis import (
    how_it_ended,
    own_output,
    server_of,
    what_is_missing,
    where_blocked,
    why_silent,
)
from lab.running.processes import Process
from lab.running.programs import Program
from lab.running.student_nodes import StudentNode
from ros_runtime import cell_notice
from ros_runtime.project import COURSE

BLOCKED = """
import threading, time
def on_request():
    print("up", flush=True)
    while True:
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
def start(tmp_path: Path) -> Iterator[Callable[..., StudentNode]]:
    """Start a program of a student; it is killed at the end."""
    started: list[StudentNode] = []

    def start(program: str, name: str = "status.py") -> StudentNode:
        file = tmp_path / name
        file.write_text(program, encoding="utf-8")
        started.append(StudentNode(file, Process([str(file)])))
        return started[-1]

    yield start
    for node in started:
        node.kill()


def test_the_line_in_which_a_callback_waits_is_quoted_and_the_program_goes_on(
    start: Callable[..., StudentNode],
) -> None:
    node = start(BLOCKED)
    assert becomes_true(lambda: "up" in node.log(), 10.0)
    for _ in range(2):
        assert why_silent(node).startswith(
            "It was blocked in line 6 of status.py (`time.sleep(60)`), in on_request(), in the loop of line 5 of "
            "status.py (`while True:`)."
        )
    assert where_blocked(node) == why_silent(node)
    assert node.is_running
    assert node.log() == "up\n"


def test_an_exception_is_named_with_the_students_line_and_without_those_of_libraries(
    start: Callable[..., StudentNode],
) -> None:
    node = start(RAISES)
    assert becomes_true(lambda: not node.is_running, 10.0)
    assert how_it_ended(node).startswith("with exit status 1: json.decoder.JSONDecodeError: Expecting value")
    assert how_it_ended(node).endswith(
        'It was raised in line 4 of status.py (`json.loads("no")`), in on_request().'
    )
    assert 'File "status.py", line 4, in on_request' in own_output(node)
    assert "decoder.py" not in own_output(node)


def test_a_program_that_has_failed_shows_what_the_self_check_says(tmp_path: Path) -> None:
    file = tmp_path / "patterns.py"
    file.write_text("pairs = [('a' 'bc')]\nfor pattern, reason in pairs:\n    pass\n", encoding="utf-8")
    program = Program(file, Process([str(file)], own_stderr=True)).wait(10.0)
    assert "ValueError: too many values to unpack" in str(program)
    last = str(program).splitlines()[-1]
    assert "Look for a missing comma in line 1 of patterns.py (`pairs = [('a' 'bc')]`): " in last


ENDS_SOON = """
import time
print("up", flush=True)
time.sleep(0.3)
raise TypeError("no response")
"""
RAISES_IN_A_THREAD = """
import threading, time
def main():
    thread = threading.Thread(target=lambda: 1 / 0)
    thread.start()
    thread.join()
    print("up", flush=True)
    time.sleep(60)
main()
"""
STARTER = """import time
def on_request(request, response):
    # YOUR CODE HERE
    return response
def on_state(message):
    # YOUR CODE HERE

    global state
    state = message
class Status:
    def ask(self):
        '''Ask.'''
        # YOUR CODE HERE

    def end(self):
        pass
"""


@pytest.fixture
def graph(monkeypatch: pytest.MonkeyPatch) -> None:
    """A graph in which no node offers a service."""
    node = SimpleNamespace(resolve_service_name=lambda name: f"/robot/{name}")
    monkeypatch.setattr(node_diagnosis, "connection", lambda: SimpleNamespace(node=node))


@pytest.mark.usefixtures("graph")
def test_a_node_of_another_service_is_not_blamed_for_the_server_that_has_ended(
    start: Callable[..., StudentNode],
) -> None:
    other = start(BLOCKED, "where_am_i.py")
    ended = start(RAISES)
    assert becomes_true(lambda: not ended.is_running, 10.0)
    assert server_of([other, ended], "get_status") is None
    assert server_of([other], "get_status") is other


@pytest.mark.usefixtures("graph")
def test_for_a_server_that_is_about_to_end_only_the_exception_is_reported(
    start: Callable[..., StudentNode], monkeypatch: pytest.MonkeyPatch
) -> None:
    node = start(ENDS_SOON)
    assert becomes_true(lambda: "up" in node.log(), 10.0)
    monkeypatch.setattr("lab.client.exchange.started_nodes", lambda: [node])
    said = str(no_answer("get_status", "no answer.")).splitlines()
    assert said[0] == "no answer."
    assert said[1].startswith("status.py has ended with exit status 1: TypeError: no response")
    assert len(said) == 2


def test_an_exception_that_has_not_ended_the_node_is_reported(start: Callable[..., StudentNode]) -> None:
    node = start(RAISES_IN_A_THREAD.replace("time.sleep(60)", "threading.Event().wait()"))
    assert becomes_true(lambda: "up" in node.log(), 10.0)
    assert why_silent(node) == "status.py still runs, but has printed ZeroDivisionError: division by zero."


def test_places_below_which_nothing_is_written_are_named(tmp_path: Path) -> None:
    file = tmp_path / "status.py"
    file.write_text(STARTER, encoding="utf-8")
    place = "lines 3 and 13"
    missing = (
        f"\nstatus.py is as the starter leaves it below `# YOUR CODE HERE` in {place}: write your code there."
    )
    assert what_is_missing([file]) == missing
    program = Program(file, Process([str(file)], own_stderr=True)).wait()
    assert str(program) == f"{program!r}\nIt printed nothing.{missing}"


def test_a_node_whose_callbacks_return_is_not_blocked(start: Callable[..., StudentNode]) -> None:
    node = start(
        "import threading\ndef main():\n    print('up', flush=True)\n    threading.Event().wait()\nmain()\n"
    )
    assert becomes_true(lambda: "up" in node.log(), 10.0)
    assert where_blocked(node) == ""


@pytest.fixture
def released(tmp_path: Path) -> Path:
    """The untouched starter of `battery_service`, beside its notebook."""
    notebook = (COURSE / "exercises/battery_service/battery_service.ipynb").read_bytes()
    (tmp_path / "battery_service.ipynb").write_bytes(notebook)
    file = tmp_path / "battery_service.py"
    file.write_text(given_in(notebook)[file.name], encoding="utf-8")
    return file


@pytest.mark.usefixtures("graph")
def test_all_places_of_an_untouched_starter_are_named(released: Path) -> None:
    assert "in lines 19 and 26: " in what_is_missing([released])
    program = released.read_text(encoding="utf-8")
    head, _, tail = program.rpartition("# YOUR CODE HERE")
    released.write_text(f"{head}response.available = True{tail}", encoding="utf-8")
    assert what_is_missing([released]) == ""


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """A notebook without a robot."""
    monkeypatch.setattr(topics, "fell_at", lambda: None)
    monkeypatch.setattr(topics, "taken_robot", str)
    monkeypatch.setattr("lab.client.exchange.started_nodes", list)


@pytest.mark.usefixtures("alone")
def test_a_wait_says_that_another_notebook_has_the_robot(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(topics, "taken_robot", lambda: "the robot of this notebook ended")
    with pytest.raises(NotInTimeError, match=r"not within 0.1 s; the robot of this notebook ended"):
        wait_until(lambda: False, 0.1, "ten steps")


@pytest.mark.usefixtures("alone")
def test_a_wait_says_what_it_waits_for(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []

    def display(content: dict[str, str], **_: object) -> SimpleNamespace:
        shown.append(content["text/plain"])
        return SimpleNamespace(update=lambda *_, **__: None)

    monkeypatch.setattr(cell_notice, "get_ipython", lambda: SimpleNamespace(kernel=True))
    monkeypatch.setattr(cell_notice, "display", display)
    monkeypatch.setattr(cell_notice, "DELAY", 0.01)
    wait_until(lambda: shown, 10.0, "ten steps")
    assert shown == ["This waits up to 10 s for: ten steps."]
