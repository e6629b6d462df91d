"""Motors that stay on are explained by the messages on motor_power."""

from __future__ import annotations

from typing import Any

import pytest
from std_srvs.srv import SetBool, Trigger

from autograder.authoring.evidence import events as ev
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.msg import RobotState
from records import answered, asked, failure_of, robot, run_of

MOTORS = exercise_module("motor_services", "model")


def truth(*, motors: Any = lambda t: True, mode: int = RobotState.STANDING) -> list[Any]:
    return [robot(tenth / 10, motors=motors(tenth / 10), mode=mode) for tenth in range(200)]


def topics(*publishes: str, subscribes: tuple[str, ...] = ()) -> Any:
    return ev.NodeTopics(t=1.1, publishes=list(publishes), subscribes=list(subscribes))


def peers(t: float, publishers: int, subscribers: int = 0) -> Any:
    return ev.RobotPeers(
        t=t,
        subscribers={"/robot/robot_state": subscribers},
        publishers={"/robot/motor_power": publishers},
    )


def switch(call: str, on: bool, t: float, *, success: bool = True, message: str = "") -> list[Any]:
    return [
        asked(call, "enable_motors", t=t, request=SetBool.Request(data=on)),
        answered(call, t=t + 0.1, response=SetBool.Response(success=success, message=message)),
    ]


@pytest.mark.parametrize(
    ("events", "seen"),
    [
        ([peers(0.9, 0), topics()], "no publisher"),
        ([peers(0.9, 0), topics("/motor_power")], "a publisher on /motor_power: remove the leading slash"),
        ([peers(0.9, 0), topics(), peers(9.0, 1)], "a publisher that appeared after the request"),
        ([peers(0.9, 1), topics("/robot/motor_power")], "no message after the request"),
        ([peers(0.9, 1), topics("/robot/motor_power"), ev.MotorPowerReceived(t=4.1, on=True)], "data: true"),
    ],
)
def test_motors_that_stay_on_are_explained_by_what_came_on_motor_power(events: list[Any], seen: str) -> None:
    run = run_of(*truth(), *events, *switch("off", False, 4.0))
    failure = failure_of(MOTORS.grants_power_off.require, run.call("off"))
    assert failure.help.startswith(f"On motor_power the grader received {seen}")


def statuses(*said_on: bool) -> list[Any]:
    events = []
    for number, on in enumerate(said_on):
        response = Trigger.Response(success=True, message=f"Motors: {'ON' if on else 'OFF'}")
        call = f"status {number}"
        events += [asked(call, t=3.0 + 4 * number), answered(call, t=3.1 + 4 * number, response=response)]
    return events


def off_from_5_to_9(t: float) -> bool:
    return not 5.0 <= t < 9.0


@pytest.mark.parametrize(
    ("events", "call", "next_step"),
    [
        (
            statuses(True, True, True),
            "status 1",
            "get_status always reported the same, although the robot's motors were switched.",
        ),
        (statuses(False, True, False), "status 0", "get_status reported the opposite of the robot's state"),
        (
            [*statuses(True, True, True), *switch("on", True, 2.0)],
            "status 1",
            "get_status reported the last request to enable_motors, not the robot's state.",
        ),
        (
            [peers(0.9, 0, 0), topics(), *statuses(True, True, True)],
            "status 1",
            "Your node does not subscribe to robot_state.",
        ),
        (
            [peers(0.9, 0, 0), topics(subscribes=("/robot_state",)), *statuses(True, True)],
            "status 1",
            "You subscribe to /robot_state, which the robot does not publish: remove the leading slash",
        ),
    ],
)
def test_a_wrong_status_is_explained_by_the_answers_so_far(
    events: list[Any], call: str, next_step: str
) -> None:
    run = run_of(*truth(motors=off_from_5_to_9), *events)
    failure = failure_of(MOTORS.tells_the_motors.require, run.call(call))
    assert failure.help.startswith(next_step)
    lesson = {
        "Your node does not": "01_robot_and_graph#listen-intro",
        "You subscribe": "01_robot_and_graph#names-why",
    }
    assert failure.see == next((see for words, see in lesson.items() if next_step.startswith(words)), "")


@pytest.mark.parametrize(
    ("motors", "message", "next_step"),
    [
        (
            lambda t: True,
            "not while it walks",
            "Nothing was switched off, but success is true: set response.success = False, which fits",
        ),
        (
            lambda t: True,
            "",
            "Nothing was switched off, but success is true: set response.success = False, and give",
        ),
        (
            lambda t: t < 4.0,
            "power off",
            "If data is false and the last robot_state.mode is RobotState.WALKING",
        ),
    ],
)
def test_a_refusal_with_success_true_is_distinguished_from_no_refusal(
    motors: Any, message: str, next_step: str
) -> None:
    walk = ev.RobotCommanded(t=2.0, command={"do": "walk", "velocity": [0.3, 0.0, 0.0]})
    off = switch("off", False, 4.0, message=message)
    run = run_of(*truth(motors=motors, mode=RobotState.WALKING), walk, *off)
    assert failure_of(MOTORS.refuses_power_off.require, run.call("off")).help.startswith(next_step)


def test_a_late_response_is_named_by_its_data_and_its_number() -> None:
    late = [
        asked("off", "enable_motors", t=6.0, request=SetBool.Request(data=False)),
        answered("off", t=11.5, response=SetBool.Response(success=True)),
    ]
    run = run_of(*truth(), *switch("on", True, 4.0), *late)
    failure = failure_of(MOTORS.power_in_time.require, run.call("off"))
    assert failure.expected.startswith("a response to enable_motors (data: false) within")
    assert failure.observed.startswith("the response to request 2 of 2 took")
