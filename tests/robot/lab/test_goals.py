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


def test_a_refused_cancel_differs_from_an_accepted_one(notebook: Kernel) -> None:
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


def test_no_server_is_reported(notebook: Kernel) -> None:
    with pytest.raises(CellError, match=r"no node offers /robot/stand_up \(StandUp\)"):
        notebook.run("lab.send_goal('stand_up', StandUp, StandUp.Goal(), timeout=0.5)")


def test_a_goal_without_an_answer_is_given_up_and_its_late_acceptance_ignored(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'doubt')")
    with pytest.raises(CellError, match=r"neither accepted nor rejected the goal within 0\.3 s"):
        notebook.run("lab.send_goal('stand_up', StandUp, StandUp.Goal(), timeout=0.3)")
    assert "no answer after 0.3 s." in notebook.run("print(lab.draw_sequence().data)")
    notebook.run(SEND + "goal.result()")
    svg = notebook.run("print(lab.draw_sequence().data)")
    assert svg.count("goal accepted.") == 1


def test_feedback_that_comes_before_the_acceptance_is_kept(notebook: Kernel) -> None:
    notebook.run("lab.run_node('hasty.py')")
    printed = notebook.run(
        SEND
        + "lab.wait_until(lambda: len(goal.feedback) == 2)\n"
        + "print([message.percent_complete for message in goal.feedback], goal.result())"
    )
    assert printed == "[10.0, 20.0] SUCCEEDED (error_code 0, error_msg '')\n"


def test_a_restarted_server_is_sent_the_next_goal(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')\n" + SEND + "first = goal")
    notebook.run("lab.run_node('riser.py', 'cancel')\n" + SEND)
    assert (
        notebook.run("print(goal.result(show_feedback=False).status, first.is_over)") == "SUCCEEDED False\n"
    )


def test_a_goal_that_the_notebook_does_not_hold_is_kept_until_its_end_and_no_longer(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    printed = notebook.run(
        "import gc, weakref\n"
        + SEND
        + "ends = []\ngoal.on_change(lambda goal: ends.append(goal.is_over))\n"
        + "kept = weakref.ref(goal)\ndel goal\ngc.collect()\nprint(kept() is not None)\n"
        + "lab.wait_until(lambda: ends[-1:] == [True])\n"
        + "lab.wait_until(lambda: gc.collect() >= 0 and kept() is None)"
    )
    assert printed == "True\n"


def test_a_listener_is_called_for_feedback_and_the_result(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    printed = notebook.run(f"""
        import threading
        {SEND}
        heard, threads = [], set()
        def listen(goal):
            heard.append((goal.status, len(goal.feedback), goal.is_over))
            threads.add(threading.current_thread().name)
        goal.on_change(listen)
        goal.result(show_feedback=False)
        lab.wait_until(lambda: heard[-1][2])
        print(heard[-1], len(heard) > 5, threads)
    """)
    assert printed == "('SUCCEEDED', 10, True) True {'lab spin'}\n"


def test_a_goal_its_cancel_and_its_result_are_in_one_drawing(notebook: Kernel) -> None:
    notebook.run("lab.run_node('riser.py', 'cancel')")
    notebook.run(SEND + "lab.wait_until(lambda: len(goal.feedback) > 4)\ngoal.cancel()\ngoal.result()")
    svg = notebook.run("print(lab.draw_sequence('A cancel').data)")
    in_order = ["send_goal", "goal accepted", "get_result", "more …", "cancel_goal", "CANCELED, error_msg"]
    places = [svg.index(label) for label in in_order]
    assert places == sorted(places)
    assert "<title>A cancel</title>" in svg
