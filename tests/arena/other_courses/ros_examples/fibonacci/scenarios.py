"""Goals and cancels, without expected answers: this module runs in the arena."""

from __future__ import annotations

from test_msgs.action import Fibonacci

from autograder.arena.stage import ActionClient, Stage

LISTENING = 1.5  # s after a result
SOON = 8.0  # s for the end of a goal that was cancelled; one that goes on takes longer
LONG = 30  # numbers, one a second


def count(stage: Stage, order: int) -> None:
    """One goal, to its end; then Ctrl-C."""
    goal = _open(stage).send_and_wait(Fibonacci.Goal(order=order), as_="count")
    goal.wait_for_result()
    stage.wait(LISTENING)
    stage.interrupt_node()


def cancel(stage: Stage) -> None:
    """A long goal, cancelled while it executes."""
    goal = _open(stage).send_and_wait(Fibonacci.Goal(order=LONG), as_="long")
    goal.wait_for_feedback(2, timeout=12.0)
    goal.cancel().wait()
    goal.wait_for_result(SOON)


def count_after_a_cancel(stage: Stage, order: int) -> None:
    """A long goal that is cancelled, and a short one after it."""
    fibonacci = _open(stage)
    canceled = fibonacci.send_and_wait(Fibonacci.Goal(order=LONG), as_="long")
    canceled.wait_for_feedback(1, timeout=12.0)
    canceled.cancel().wait()
    canceled.wait_for_result(SOON)
    fibonacci.send_and_wait(Fibonacci.Goal(order=order), as_="count").wait_for_result()


def _open(stage: Stage) -> ActionClient:
    fibonacci = stage.action("fibonacci", Fibonacci)
    stage.open()
    return fibonacci
