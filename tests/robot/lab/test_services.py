"""Calling services of students' nodes, and the errors if a call fails."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from kernels import CellError, Kernel

ADDER = "node = lab.run_node('adder.py'); lab.call('add', AddTwoInts)"


@pytest.fixture
def notebook(kernel: Kernel) -> Iterator[Kernel]:
    kernel.run("from humanoid_interfaces.srv import AddTwoInts\nfrom std_srvs.srv import Trigger")
    yield kernel
    kernel.run("lab.stop_nodes()")


def test_a_node_answers(notebook: Kernel) -> None:
    printed = notebook.run("""
node = lab.run_node("adder.py")
print(lab.call("add", AddTwoInts, AddTwoInts.Request(a=2, b=3)).sum, node.is_running)
node.stop()
print(node.is_running, node.exit_status, node.log())""")
    assert printed == "5 True\nFalse 0 answered 5\n\n"


def test_the_same_file_again_replaces_the_old_node(notebook: Kernel) -> None:
    printed = notebook.run("""
old = lab.run_node("adder.py", "100")
new = lab.run_node("adder.py", "200")
print(old.is_running, [lab.call("add", AddTwoInts).sum for _ in range(5)])""")
    assert printed == "False [200, 200, 200, 200, 200]\n"


@pytest.mark.parametrize(
    ("cell", "expected"),
    [
        (
            "lab.call('ad', AddTwoInts)",
            r"no node offers /robot/ad \(AddTwoInts\).*the nodes offer: /robot/add\.",
        ),
        ("lab.call('add', AddTwoInts, Trigger.Request())", r"add takes a AddTwoInts\.Request"),
        (
            "lab.call('add', AddTwoInts, AddTwoInts.Request(b=-1))",
            r"adder\.py has ended with exit status 1[\s\S]*ValueError: b is negative",
        ),
        (
            "lab.call('add', AddTwoInts, AddTwoInts.Request(a=13))",
            r"exit status 1: TypeError\. Your service callback of add, "
            r"add\(\) in line \d+ of adder\.py .* returned nothing.*`return response`",
        ),
        ("lab.run_node('broken.py')", r"broken\.py ended at once with exit status 1[\s\S]*no such robot"),
        ("lab.run_node('gone.py')", r"no file gone\.py .*%%writefile gone\.py"),
    ],
)
def test_an_error_reports_the_observation(notebook: Kernel, cell: str, expected: str) -> None:
    notebook.run(ADDER)
    with pytest.raises(CellError, match=expected):
        notebook.run(cell)


def test_a_wrong_type_is_reported_and_the_right_one_still_works(notebook: Kernel) -> None:
    notebook.run(ADDER)
    with pytest.raises(CellError, match="but of type humanoid_interfaces/srv/AddTwoInts"):
        notebook.run("lab.call('add', Trigger, timeout=0.5)")
    assert notebook.run("print(lab.call('add', AddTwoInts).sum)") == "0\n"


def test_a_slow_server_times_out_and_its_late_response_is_ignored(notebook: Kernel) -> None:
    notebook.run(ADDER)
    with pytest.raises(
        CellError, match=r"no answer from add within 0\.5 s[\s\S]* of adder\.py \(`time\.sleep\("
    ):
        notebook.run("lab.call('add', AddTwoInts, AddTwoInts.Request(a=-2), timeout=0.5)")
    drawn = notebook.run("print(lab.draw_sequence().data)")
    assert "notebook to add server: add: a -2." in drawn
    assert "notebook: no answer after 0.5 s." in drawn
    pending = "lab.client.connection.connection().client(AddTwoInts, 'add').endpoint._pending_requests"
    assert notebook.run(f"print({pending})") == "{}\n"
    printed = notebook.run(
        "print(lab.call('add', AddTwoInts, AddTwoInts.Request(a=7), timeout=10).sum)\n"
        "lab.wait_until(lambda: 'answered 7' in node.log())\nprint(node.log())"
    )
    assert printed == "7\nanswered 0\nanswered -2\nanswered 7\n\n"


def test_a_killed_server_still_looks_ready(notebook: Kernel) -> None:
    notebook.run(ADDER)
    printed = notebook.run("node.kill(); print(lab.service_is_ready('add', AddTwoInts), node.is_running)")
    assert printed == "True False\n"


def test_a_node_that_ignores_ctrl_c_is_killed_and_that_is_printed(notebook: Kernel) -> None:
    notebook.run("lab.running.student_nodes.START_TIMEOUT = 1.0\nnode = lab.run_node('stubborn.py')")
    notebook.run("lab.wait_until(lambda: 'up' in node.log())")
    assert "stubborn.py did not end within 3 s of Ctrl-C and was killed" in notebook.run("node.stop()")
    notebook.run("lab.running.student_nodes.START_TIMEOUT = 10.0")


def test_the_call_is_drawn_with_its_answer(notebook: Kernel) -> None:
    notebook.run("lab.run_node('adder.py')")
    svg = notebook.run(
        "lab.call('add', AddTwoInts, AddTwoInts.Request(a=1, b=2)); print(lab.draw_sequence().data)"
    )
    assert "notebook to add server: add: a 1, b 2." in svg
    assert "add server to notebook: sum 3." in svg
