"""What a balance controller is told that publishes too much, too little, or the wrong gains for what it accepted."""

from __future__ import annotations

from typing import Any

import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue, SetParametersResult
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically
from records import answered, asked, failure_of, robot, run_of, said

from autograder.authoring import events as ev
from autograder.authoring.failure import CannotBeJudged, Failure
from autograder.authoring.readiness import require_ready
from autograder.authoring.transcript import Transcript
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.msg import BalanceGains, RobotState

SETS, PUBLISHED, REFUSED, STANDING = (
    exercise_module("balance_controller", name) for name in ("sets", "published", "refused", "standing")
)
DEFAULTS = SETS.DEFAULTS
ASKED, SET, END = 2.0, 4.0, 8.0  # s


def double(value: float) -> ParameterValue:
    return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)


def message(t: float, **changes: float) -> Any:
    return ev.MessageReceived(t=t, topic="balance_gains", message=BalanceGains(**(DEFAULTS | changes)))


def requested(values: dict[str, float], *results: SetParametersResult, together: bool = False) -> list[Any]:
    """Return the events of the request “set” for these values, and of its answer."""
    parameters = [Parameter(name=name, value=double(value)) for name, value in values.items()]
    if together:
        request, response = (
            SetParametersAtomically.Request(parameters=parameters),
            SetParametersAtomically.Response(result=results[0]),
        )
        service = "balance_controller/set_parameters_atomically"
    else:
        request = SetParameters.Request(parameters=parameters)
        response = SetParameters.Response(results=list(results))
        service = "balance_controller/set_parameters"
    return [asked("set", service, t=SET, request=request), answered("set", t=SET + 0.1, response=response)]


def controller(*events: Any) -> Transcript:
    values = [double(value) for value in DEFAULTS.values()]
    start = [
        asked("at the start", "balance_controller/get_parameters", t=ASKED, request=GetParameters.Request()),
        answered("at the start", t=ASKED + 0.1, response=GetParameters.Response(values=values)),
    ]
    return run_of(*start, *events, until=END)


YES = SetParametersResult(successful=True)
NO = SetParametersResult(successful=False, reason="too weak")
PAIR = {"kp_pitch": 320.0, "kd_roll": 44.0}


@pytest.mark.parametrize("together", [True, False])
def test_each_accepted_set_has_one_message(together: bool) -> None:
    sets = requested(PAIR, *([YES] if together else [YES, YES]), together=together)
    first = [] if together else [message(SET + 0.05, kp_pitch=320.0)]
    PUBLISHED.require_once(controller(*sets, *first, message(SET + 0.06, **PAIR)), "set")


@pytest.mark.parametrize(
    ("published", "next_step"),
    [
        ([message(SET + 0.1, **PAIR), message(SET + 0.1, **PAIR)], "behind the loop"),
        ([message(SET + 0.1 * number, **PAIR) for number in range(5)], "from no timer"),
        ([message(SET + 0.1)], "values of before the set"),
        ([message(SET + 0.1, **PAIR, kp_roll=0.0)], "A new message holds zeros"),
        ([message(SET + 0.1, **PAIR, kp_roll=333.0)], "must leave nothing behind"),
        (
            [message(SET + 0.1, **(PAIR | {"kp_pitch": 302.0, "kp_roll": 320.0}))],
            "pitch and roll are exchanged",
        ),
        ([message(ASKED)], "Publish in the post-set callback"),
        ([message(SET + 3.0, **PAIR)], "not from a timer"),
        ([message(SET + 0.1, kp_pitch=320.0)], "Other gains are new"),
        ([], "add_post_set_parameters_callback"),
        ([ev.Mark(t=ASKED, name="nobody publishes")], "letter by letter"),
    ],
)
def test_what_is_published_for_a_set_is_compared_with_it(published: list[Any], next_step: str) -> None:
    run = controller(*requested(PAIR, YES, together=True), *published)
    assert next_step in failure_of(PUBLISHED.require_once, run, "set").help


def test_a_refused_set_is_silent_and_has_a_reason() -> None:
    refused = controller(*requested(PAIR, NO, together=True))
    PUBLISHED.require_silence(refused, "set")
    REFUSED.require_refused(refused, "set", "it is bad", "Refuse it.")
    told = controller(*requested(PAIR, NO, together=True), message(SET + 0.1, **PAIR))
    assert "only says yes or no" in failure_of(PUBLISHED.require_silence, told, "set").help
    silent = controller(*requested(PAIR, SetParametersResult(successful=False), together=True))
    assert "a reason" in failure_of(REFUSED.require_refused, silent, "set", "", "").help


def test_a_set_that_was_accepted_is_not_refused() -> None:
    run = controller(*requested({"kp_pitch": 40.0}, YES))
    assert failure_of(REFUSED.require_refused, run, "set", "gravity", "Refuse it.").help == "Refuse it."
    refused = controller(*requested(PAIR, NO, together=True))
    assert "too weak" in failure_of(PUBLISHED.require_accepted, refused, "set").observed


def test_gains_that_are_no_doubles_are_named() -> None:
    response = GetParameters.Response(
        values=[ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=276)]
    )
    run = run_of(asked("at the start", "x/get_parameters"), answered("at the start", response=response))
    assert failure_of(SETS.require_doubles, run, "at the start").observed == "an integer"


def started_with(*events: Any) -> Transcript:
    run = run_of(*events, ready=False, until=END)
    return Transcript(run.scenario, {"name": "kp_pitch", "value": "40.0"}, run.events, run.ground_truth)


def test_a_bad_start_ends_with_a_status_and_a_line() -> None:
    words = said("balance_controller cannot start: kp_pitch is 40.0", t=2.0)
    REFUSED.require_bad_start_refused(started_with(*words, ev.NodeExited(t=2.0, returncode=1)))
    assert "before you declare" in failure_of(REFUSED.require_bad_start_refused, started_with()).help
    for events in ([ev.NodeExited(t=2.0, returncode=1)], [*words, ev.NodeExited(t=2.0, returncode=0)]):
        failure_of(REFUSED.require_bad_start_refused, started_with(*events))


def pushed(*, fallen_from: float = 99.0, off: bool = False) -> Transcript:
    states = [
        robot(0.1 * n, mode=RobotState.FALLEN if 0.1 * n >= fallen_from else RobotState.STANDING)
        for n in range(1, int(END * 10))
    ]
    power = [ev.MotorPowerReceived(t=1.5, on=False)] if off else []
    push = ev.RobotCommanded(t=4.0, command={"do": "push", "impulse": [10.0, 0.0, 0.0]})
    return run_of(*states, *power, push, message(3.0), until=END)


def test_a_robot_that_falls_is_told_with_which_gains() -> None:
    STANDING.require_standing_after_push(pushed())
    failure = failure_of(STANDING.require_standing_after_push, pushed(fallen_from=5.0))
    assert "1.0 s after the push" in failure.observed
    assert "kp_pitch 276" in failure.observed
    assert (
        "before anybody pushed"
        in failure_of(STANDING.require_standing_after_push, pushed(fallen_from=3.5)).observed
    )
    assert (
        "switched its motors off"
        in failure_of(STANDING.require_standing_after_push, pushed(fallen_from=5.0, off=True)).help
    )


def test_without_a_push_nothing_is_proved() -> None:
    run = run_of(*(robot(0.1 * n) for n in range(1, 80)), until=END)
    with pytest.raises((CannotBeJudged, Failure)):
        STANDING.require_standing_after_push(run)


def test_a_node_of_another_name_is_told_the_tasks() -> None:
    services = ("describe_parameters", "get_parameters", "set_parameters", "set_parameters_atomically")
    missing = [f"balance_controller/{service}" for service in services]
    absent = ev.NodeNotReady(t=3.0, missing=missing, offered=[], waited=20.0)
    assert (
        "No node is called balance_controller" in failure_of(require_ready, run_of(absent, ready=False)).help
    )
