"""Programs that end by themselves, and programs that do not."""

from __future__ import annotations

import pytest
from kernels import CellError, Kernel


def test_a_program_is_run_to_its_end(kernel: Kernel) -> None:
    printed = kernel.run("""
client = lab.run_program("client.py", "3", "x")
print(client.exit_status, client.stopped, 0 < client.seconds < 30)
print(client.stdout, client.stderr)""")
    assert printed == "3 False True\narguments: 3 x\nwith ROS: True\n a complaint\n\n"


def test_a_program_is_shown_with_its_state_and_output(kernel: Kernel) -> None:
    printed = kernel.run("print(client := lab.run_program('client.py', '0'))\nprint(repr(client))")
    state = printed.splitlines()[-1]
    assert state.startswith("<client.py: exit status 0 after ")
    assert printed.splitlines()[0] == state
    assert "\n    arguments: 0\n    with ROS: True\n    a complaint\n" in printed


def test_a_program_that_does_not_end_is_stopped_and_has_no_exit_status(kernel: Kernel) -> None:
    printed = kernel.run("""
client = lab.run_program("client.py", timeout=2)
print(client.stopped, client.exit_status)
print(repr(client))""")
    assert printed.startswith("True None\n<client.py: had not ended after 2.")
    assert kernel.children() == []


def test_a_started_program_runs_beside_the_notebook(kernel: Kernel) -> None:
    printed = kernel.run("""
client = lab.start_program("client.py")
lab.wait_until(lambda: "a complaint" in client.stderr)
print(client.exit_status, repr(client).split()[1], client.stdout)
client.stop()""")
    assert printed == "None running arguments:\nwith ROS: True\n\n"


def test_the_same_file_again_replaces_the_one_that_still_runs(kernel: Kernel) -> None:
    printed = kernel.run("""
old = lab.start_program("client.py")
new = lab.start_program("client.py")
print(old.stopped, new.stopped)""")
    assert printed == "True False\n"
    assert len(kernel.children()) == 1


def test_the_end_of_the_session_ends_a_program(kernel: Kernel) -> None:
    kernel.run("client = lab.start_program('client.py')")
    assert kernel.run("lab.stop_everything()\nprint(client.stopped)") == "True\n"
    assert kernel.children() == []


def test_a_missing_file_is_named(kernel: Kernel) -> None:
    with pytest.raises(CellError, match=r"no file gone\.py .*%%writefile gone\.py"):
        kernel.run("lab.run_program('gone.py')")
