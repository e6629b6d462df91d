"""Sending goals to a student's action server, following and cancelling them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from kernels import CellError, Kernel

SEND = "goal = lab.send_goal('stand_up', StandUp, StandUp.Goal())\n"


@pytest.fixture
def notebook(kernel: Kernel) -> Iterator[Kernel]:
    kernel.run("from humanoid_interfaces.action import StandUp")
    yield kernel
    kernel.run("lab.stop_nodes()")


def test_feedback_is_printed_while_waiting_and_the_result_returned(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    printed = notebook.run(SEND + "print(goal.status in ('ACCEPTED', 'EXECUTING'))\nprint(goal.result())")
    assert printed.startswith("True\n")
    assert "feedback: phase 'rising', percent_complete" in printed
    assert printed.endswith("SUCCEEDED (error_code 0, error_msg 'up')\n")


def test_a_cancel_is_accepted_and_the_goal_ends_canceled(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    printed = notebook.run(
        SEND
        + "lab.wait_until(lambda: goal.feedback)\nprint(goal.cancel())\nprint(goal.result(show_feedback=False))"
    )
    assert printed == "accepted, return_code 0\nCANCELED (error_code 0, error_msg 'sat down again')\n"
    assert notebook.run("print(goal.cancel())") == "not accepted, return_code 3\n"


def test_a_refused_cancel_is_told_from_an_accepted_one(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'no-cancel')")
    printed = notebook.run(SEND + "print(goal.cancel())\nprint(goal.result(show_feedback=False).status)")
    assert printed == "not accepted, return_code 0\nSUCCEEDED\n"


def test_a_rejected_goal_has_no_result(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'reject')")
    assert notebook.run(SEND + "print(goal)") == "<goal of stand_up: rejected, 0 feedback messages>\n"
    with pytest.raises(CellError, match="rejected this goal"):
        notebook.run("goal.result()")


def test_a_goal_that_takes_longer_can_be_waited_for_again(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    with pytest.raises(CellError, match=r"no result from stand_up within 0\.1 s"):
        notebook.run(SEND + "goal.result(timeout=0.1)")
    assert notebook.run("print(goal.result(show_feedback=False).status)") == "SUCCEEDED\n"


def test_no_server_is_told(notebook: Kernel) -> None:
    with pytest.raises(CellError, match=r"nobody offers /robot/stand_up \(StandUp\)"):
        notebook.run("lab.send_goal('stand_up', StandUp, StandUp.Goal(), timeout=0.5)")


def test_a_listener_hears_of_feedback_and_of_the_end(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    printed = notebook.run(
        SEND
        + "heard = []\ngoal.on_change(lambda goal: heard.append((goal.status, len(goal.feedback))))\n"
        + "goal.result(show_feedback=False)\nprint(heard[-1], len(heard) > 5)"
    )
    assert printed == "('SUCCEEDED', 10) True\n"


def test_the_goal_its_cancel_and_its_end_are_one_drawing(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    notebook.run(SEND + "lab.wait_until(lambda: len(goal.feedback) > 4)\ngoal.cancel()\ngoal.result()")
    svg = notebook.run("print(lab.draw_sequence('A cancel').data)")
    in_order = ["send_goal", "goal accepted", "get_result", "more …", "cancel_goal", "CANCELED, error_msg"]
    places = [svg.index(label) for label in in_order]
    assert places == sorted(places)
    assert "<title>A cancel</title>" in svg
