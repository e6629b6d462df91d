"""The picture of a goal's states shows the states of the last goal, with their times and order."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

import lab
from humanoid_interfaces.action import WalkTo
from lab.client.interaction_log import log
from ros_runtime.message_constants import GoalStatus
from ros_runtime.record.client_events import GoalAnswered, GoalSent, ResultReceived, StatusSeen


@pytest.fixture(autouse=True)
def empty_log() -> Iterator[None]:
    log.clear()
    yield
    log.clear()


def send(*, accepted: bool = True, goal: str = "go 1") -> None:
    log.append(GoalSent(t=10.0, goal=goal, action="go", request=WalkTo.Goal()))
    log.append(GoalAnswered(t=10.02, goal=goal, accepted=accepted))


def see(*statuses: tuple[float, GoalStatus], goal: str = "go 1") -> None:
    for after, status in statuses:
        log.append(StatusSeen(t=10.0 + after, goal=goal, status=status))


def end(after: float, status: GoalStatus, goal: str = "go 1") -> None:
    log.append(ResultReceived(t=10.0 + after, goal=goal, status=status, result=WalkTo.Result()))


def lit(svg: str) -> list[str]:
    """The highlighted states, in the order of their times."""
    return [state for state, _ in sorted(_lit_after(svg).items(), key=lambda lights: lights[1])]


def _lit_after(svg: str) -> dict[str, float]:
    return {state: float(at) for state, at in re.findall(r"-(\w+) \{ 0%, ([\d.]+)% \{ opacity: 0 \}", svg)}


def test_the_states_are_highlighted_in_the_order_of_the_run() -> None:
    send()
    see((0.03, GoalStatus.EXECUTING), (1.5, GoalStatus.CANCELING), (1.6, GoalStatus.CANCELING))
    end(2.5, GoalStatus.CANCELED)
    svg = lab.draw_goal_states("A cancel").data
    assert lit(svg) == ["ACCEPTED", "EXECUTING", "CANCELING", "CANCELED"]
    assert (
        "A cancel: SENT at 0.00 s, then ACCEPTED at 0.02 s, then EXECUTING at 0.03 s, then CANCELING at 1.50 s, "
        "then CANCELED at 2.50 s." in svg
    )
    for number, state in enumerate(GoalStatus):
        assert (f"{number}  {state.name}" in svg) == (state is not GoalStatus.UNKNOWN)
    assert "prefers-reduced-motion" in svg


def test_a_rejected_goal_has_no_status() -> None:
    send(accepted=False)
    assert lit(lab.draw_goal_states().data) == ["REJECTED"]


def test_a_state_that_the_status_topic_skipped_is_highlighted_with_the_next() -> None:
    send()
    end(0.05, GoalStatus.ABORTED)
    svg = lab.draw_goal_states().data
    assert set(lit(svg)) == {"ACCEPTED", "EXECUTING", "ABORTED"}
    assert "EXECUTING at 0.05 s" in svg


def test_another_goal_of_the_interaction_is_not_mixed_in() -> None:
    send()
    send(goal="go 2")
    end(1.0, GoalStatus.ABORTED)
    end(2.0, GoalStatus.SUCCEEDED, goal="go 2")
    assert "SUCCEEDED at 2.00 s" in (svg := lab.draw_goal_states().data)
    assert "ABORTED at" not in svg


def test_without_a_goal_it_says_what_to_do() -> None:
    with pytest.raises(lab.LabError, match=r"use lab\.send_goal\(\) first"):
        lab.draw_goal_states()
