"""Which events of a notebook are drawn, and which are dropped."""

from __future__ import annotations

import pytest
from std_srvs.srv import SetBool

from humanoid_interfaces.action import StandUp
from lab.client.interaction_log import InteractionLog
from lab.client.messages import GaveUp, ModeChanged
from ros_runtime.message_constants import GoalStatus, RobotMode
from ros_runtime.record.client_events import (
    CancelAnswered,
    CancelSent,
    FeedbackReceived,
    GoalAnswered,
    GoalSent,
    ResultReceived,
    ServiceAnswered,
    ServiceCalled,
    StatusSeen,
    Unanswered,
)

GOAL = "stand_up 1"


@pytest.fixture
def log() -> InteractionLog:
    return InteractionLog()


def test_a_call_is_a_request_and_its_answer(log: InteractionLog) -> None:
    call(log, 1)
    assert drawn(log) == [
        "notebook > march server: march: data True",
        "march server > notebook: success True",
    ]


def test_a_goal_is_drawn_with_each_new_status(log: InteractionLog) -> None:
    send_goal(log)
    see_status(log, GoalStatus.ACCEPTED, GoalStatus.EXECUTING)
    log.append(CancelSent(cancel="cancel 1", goal=GOAL, by="client"))
    log.append(CancelAnswered(cancel="cancel 1", return_code=0, canceling=[GOAL]))
    end_goal(log, GoalStatus.CANCELED)
    see_status(log, GoalStatus.CANCELED)
    assert drawn(log) == [
        "notebook > stand_up server: send_goal: empty",
        "stand_up server > notebook: goal accepted",
        "notebook > stand_up server: get_result",
        "stand_up server > notebook: status: EXECUTING",
        "notebook > stand_up server: cancel_goal",
        "stand_up server > notebook: cancel accepted, return_code 0",
        "stand_up server > notebook: CANCELED, error_msg 'done'",
    ]


def test_a_status_that_arrives_before_the_acceptance_is_drawn(log: InteractionLog) -> None:
    log.append(GoalSent(goal=GOAL, action="stand_up", request=StandUp.Goal()))
    see_status(log, GoalStatus.EXECUTING)
    log.append(GoalAnswered(goal=GOAL, accepted=True))
    see_status(log, GoalStatus.EXECUTING)
    assert [line for line in drawn(log) if "status" in line] == [
        "stand_up server > notebook: status: EXECUTING"
    ]


def test_the_next_call_begins_a_new_drawing(log: InteractionLog) -> None:
    call(log, 1)
    log.append(ModeChanged(mode=RobotMode.WALKING))
    call(log, 2)
    assert len(drawn(log)) == 2
    assert log.count(ServiceCalled) == 1


def test_what_happens_while_a_goal_is_pending_belongs_to_it(log: InteractionLog) -> None:
    send_goal(log)
    call(log, 1)
    log.append(ModeChanged(mode=RobotMode.WALKING))
    end_goal(log, GoalStatus.SUCCEEDED)
    assert drawn(log)[0] == "notebook > stand_up server: send_goal: empty"
    assert drawn(log)[-2:] == [
        "robot > robot: WALKING",
        "stand_up server > notebook: SUCCEEDED, error_msg 'done'",
    ]


def test_a_late_cancel_continues_its_goal(log: InteractionLog) -> None:
    send_goal(log)
    end_goal(log, GoalStatus.SUCCEEDED)
    log.append(CancelSent(cancel="cancel 1", goal=GOAL, by="client"))
    log.append(CancelAnswered(cancel="cancel 1", return_code=3, canceling=[]))
    assert drawn(log)[-1] == "stand_up server > notebook: cancel not accepted, return_code 3"
    assert drawn(log)[0] == "notebook > stand_up server: send_goal: empty"


def test_a_timeout_is_drawn_and_ends_the_pending_request(log: InteractionLog) -> None:
    log.append(ServiceCalled(call="march 1", service="march", request=SetBool.Request()))
    log.append(Unanswered(what="call", id="march 1", waited=0.5003))
    log.append(GaveUp(timeout=0.5))
    assert drawn(log)[-1] == "notebook > notebook: no answer after 0.5 s"
    call(log, 2)
    assert len(drawn(log)) == 2


def test_a_goal_after_its_timeout_does_not_extend_the_next_drawing(log: InteractionLog) -> None:
    send_goal(log)
    log.append(Unanswered(what="result", id=GOAL, waited=1.0))
    call(log, 1)
    assert len(drawn(log)) == 2
    log.append(FeedbackReceived(goal=GOAL, feedback=StandUp.Feedback(phase="rising")))
    assert drawn(log)[-1] == "stand_up server > notebook: feedback: phase 'rising'"


def test_a_message_that_is_modified_afterwards_is_drawn_unmodified(log: InteractionLog) -> None:
    request = SetBool.Request(data=True)
    log.append(ServiceCalled(call="march 1", service="march", request=request))
    request.data = False
    assert drawn(log) == ["notebook > march server: march: data True"]


def drawn(log: InteractionLog) -> list[str]:
    return [f"{message.sender} > {message.receiver}: {message.label}" for message in log.messages()]


def call(log: InteractionLog, number: int) -> None:
    name = f"march {number}"
    log.append(ServiceCalled(call=name, service="march", request=SetBool.Request(data=True)))
    log.append(ServiceAnswered(call=name, response=SetBool.Response(success=True)))


def send_goal(log: InteractionLog) -> None:
    log.append(GoalSent(goal=GOAL, action="stand_up", request=StandUp.Goal()))
    log.append(GoalAnswered(goal=GOAL, accepted=True))


def see_status(log: InteractionLog, *statuses: int) -> None:
    for status in statuses:
        log.append(StatusSeen(goal=GOAL, status=status))


def end_goal(log: InteractionLog, status: int) -> None:
    log.append(ResultReceived(goal=GOAL, status=status, result=StandUp.Result(error_msg="done")))
