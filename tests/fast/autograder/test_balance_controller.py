"""The failures of a balance controller that publishes too often, too rarely, or wrong gains for an accepted set."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue, SetParametersResult
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically

from autograder.authoring.diagnosis.readiness import require_ready
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.msg import BalanceGains, RobotState
from records import answered, asked, failure_of, robot, run_of, said

MODEL, GAINS = (exercise_module("balance_controller", name) for name in ("model", "gains"))
DEFAULTS = GAINS.DEFAULTS
ASKED, SET, END = 2.0, 4.0, 8.0  # s
YES = SetParametersResult(successful=True)
NO = SetParametersResult(successful=False, reason="too weak")
PAIR = {"kp_pitch": 320.0, "kd_roll": 44.0}


def double(value: float) -> ParameterValue:
    return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)


def message(t: float, **changes: float) -> Any:
    return ev.MessageReceived(t=t, topic="balance_gains", message=BalanceGains(**(DEFAULTS | changes)))


def requested(values: dict[str, float], *results: SetParametersResult, together: bool = False) -> list[Any]:
    """Return the events of a request for these values, and of its answer."""
    parameters = [Parameter(name=name, value=double(value)) for name, value in values.items()]
    service, request, response = (
        (
            "set_parameters_atomically",
            SetParametersAtomically.Request(parameters=parameters),
            SetParametersAtomically.Response(result=results[0]),
        )
        if together
        else (
            "set_parameters",
            SetParameters.Request(parameters=parameters),
            SetParameters.Response(results=list(results)),
        )
    )
    return [
        asked("set", f"balance_controller/{service}", t=SET, request=request),
        answered("set", t=SET + 0.1, response=response),
    ]


def controller(
    *events: Any, values: tuple[ParameterValue, ...] = (*map(double, DEFAULTS.values()),)
) -> Transcript:
    start = [
        asked("get", "balance_controller/get_parameters", t=ASKED, request=GetParameters.Request()),
        answered("get", t=ASKED + 0.1, response=GetParameters.Response(values=values)),
    ]
    return run_of(*start, *events, until=END)


@pytest.mark.parametrize("together", [True, False])
def test_each_accepted_set_request_has_one_message(together: bool) -> None:
    sets = requested(PAIR, *([YES] if together else [YES, YES]), together=together)
    first = [] if together else [message(SET + 0.05, kp_pitch=320.0)]
    run = controller(*sets, *first, message(SET + 0.06, **PAIR))
    assert MODEL.publishes_them_in_time.judge(run)
    assert MODEL.one_message_each.judge(run)


@pytest.mark.parametrize(
    ("obligation", "published", "next_step"),
    [
        ("one_message_each", [message(SET + 0.1, **PAIR), message(SET + 0.1, **PAIR)], "after the loop"),
        (
            "one_message_each",
            [message(SET + 0.1 * number, **PAIR) for number in range(5)],
            "nor from a timer",
        ),
        ("publishes_them_in_time", [message(SET + 0.1)], "values from before the set"),
        (
            "publishes_them_in_time",
            [message(SET + 0.1, **PAIR, kp_roll=0.0)],
            "In a new message every field is 0",
        ),
        ("publishes_them_in_time", [message(SET + 0.1, **PAIR, kp_roll=333.0)], "no value of a rejected set"),
        ("publishes_them_in_time", [message(SET + 0.1, **PAIR, kp_roll=302.4)], "without rounding"),
        (
            "publishes_them_in_time",
            [message(SET + 0.1, **(PAIR | {"kp_pitch": 302.0, "kp_roll": 320.0}))],
            "pitch and roll are swapped",
        ),
        ("publishes_them_in_time", [message(ASKED)], "Publish in the post-set callback"),
        ("publishes_them_in_time", [message(SET + 3.0, **PAIR)], "not from a timer"),
        ("publishes_them_in_time", [message(SET + 0.1, kp_pitch=320.0)], "old values of some gains"),
        ("publishes_them_in_time", [], "add_post_set_parameters_callback"),
        ("publishes_them_in_time", [ev.Mark(t=ASKED, name="nobody publishes")], "give create_publisher"),
    ],
)
def test_the_published_gains_are_compared_with_the_set_request(
    obligation: str, published: list[Any], next_step: str
) -> None:
    run = controller(*requested(PAIR, YES, together=True), *published)
    assert next_step in failure_of(getattr(MODEL, obligation).judge, run).help


def test_a_rejected_set_request_publishes_nothing_and_has_a_reason() -> None:
    refused = controller(*requested(PAIR, NO, together=True))
    assert MODEL.publishes_nothing_for_rejected_sets.judge(refused)
    assert MODEL.gives_a_reason.judge(refused)
    assert "too weak" in failure_of(MODEL.accepts_the_table.judge, refused).observed
    published = controller(*requested(PAIR, NO, together=True), message(SET + 0.1, **PAIR))
    assert (
        "Only accept or reject" in failure_of(MODEL.publishes_nothing_for_rejected_sets.judge, published).help
    )
    silent = controller(*requested(PAIR, SetParametersResult(successful=False), together=True))
    assert "a reason" in failure_of(MODEL.gives_a_reason.judge, silent).help


def test_a_bad_gain_is_refused_wherever_it_stands_in_a_set() -> None:
    alone = controller(*requested({"kp_pitch": 40.0}, YES))
    assert "reject a kp" in failure_of(MODEL.refuses_weak_gains.judge, alone).help
    behind = controller(*requested({"kd_roll": 40.0, "kp_pitch": 40.0}, YES, together=True))
    assert "not only the first one" in failure_of(MODEL.refuses_weak_gains.judge, behind).help
    assert not MODEL.refuses_no_numbers.judge(behind)


def test_gains_that_are_integers_or_not_the_robots_are_named() -> None:
    integers = controller(values=(ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=276),))
    assert failure_of(MODEL.has_its_gains.judge, integers).observed == "an integer"
    others = controller(values=tuple(double(value - 5.0) for value in DEFAULTS.values()))
    assert "the robot's own" in failure_of(MODEL.has_its_gains.judge, others).expected


def started_with(*events: Any) -> Transcript:
    return replace(run_of(*events, ready=False, until=END), params={"name": "kp_pitch", "value": "40.0"})


def test_a_bad_start_ends_with_a_status_and_a_line() -> None:
    refuses, words = MODEL.refuses_to_start.judge, said("cannot start: kp_pitch is 40.0", t=2.0)
    assert refuses(started_with(*words, ev.NodeExited(t=2.0, returncode=1)))
    assert "before you declare" in failure_of(refuses, started_with()).help
    for events in ([ev.NodeExited(t=2.0, returncode=1)], [*words, ev.NodeExited(t=2.0, returncode=0)]):
        failure_of(refuses, started_with(*events))


def pushed(*, fallen_from: float = 99.0, off: bool = False) -> Transcript:
    modes = {False: RobotState.STANDING, True: RobotState.FALLEN}
    states = [robot(0.1 * n, mode=modes[0.1 * n >= fallen_from]) for n in range(1, int(END * 10))]
    power = [ev.MotorPowerReceived(t=1.5, on=False)] if off else []
    push = ev.RobotCommanded(t=4.0, command={"do": "push", "impulse": [10.0, 0.0, 0.0]})
    return controller(*states, *power, push, message(3.0))


def test_a_robot_that_falls_is_reported_with_its_gains() -> None:
    survives = MODEL.survives.judge
    assert survives(pushed())
    failure = failure_of(survives, pushed(fallen_from=5.0))
    assert "the robot fell at 5.0 s; it was pushed at 4.0 s" in failure.observed
    assert "kp_pitch 276" in failure.observed
    assert "fell at 3.5 s" in failure_of(survives, pushed(fallen_from=3.5)).observed
    assert "switched the motors off" in failure_of(survives, pushed(fallen_from=5.0, off=True)).help
    with pytest.raises(CannotBeJudged):
        survives(controller(*(robot(0.1 * n) for n in range(1, 80))))


def test_a_node_of_another_name_is_given_the_tasks() -> None:
    services = ("describe_parameters", "get_parameters", "set_parameters", "set_parameters_atomically")
    missing = [f"balance_controller/{service}" for service in services]
    absent = ev.NodeNotReady(t=3.0, missing=missing, offered=[], waited=20.0)
    run = run_of(absent, ready=False)
    assert "No node is called balance_controller" in failure_of(require_ready, run).help
