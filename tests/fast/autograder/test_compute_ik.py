"""Angles are judged by the hand's position that results, and known mistakes are named."""

import math

import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue, SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.srv import ComputeIK
from records import failure_of

MODEL = exercise_module("compute_ik", "model")
TwoLinkArm = exercise_module("compute_ik", "two_link_arm").TwoLinkArm
TARGET = (0.4, 0.3)
SHOULDER, ELBOW = math.radians(14.5383), math.radians(49.4584)  # the elbow below
DIRECTION = math.atan2(TARGET[1], TARGET[0])
INSIDE = DIRECTION - SHOULDER  # the triangle's angle at the shoulder
LENGTHS = ("upper_arm_length", "forearm_length")


def run(*answers, lengths=(), accepted=True, together=False, started_with=None):
    """Return a run in which lengths are set first and then each question (target, elbow_up, frame) gets an answer."""
    events = []
    if lengths:
        values = [ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=each) for each in lengths]
        asked = [Parameter(name=name, value=value) for name, value in zip(LENGTHS, values, strict=False)]
        result = SetParametersResult(successful=accepted)
        kind = SetParametersAtomically if together else SetParameters
        service = "/ik/set_parameters_atomically" if together else "/ik/set_parameters"
        request = kind.Request(parameters=asked)
        response = kind.Response(**({"result": result} if together else {"results": [result] * len(asked)}))
        events.append(ev.ServiceCalled(t=0.1, call="set", service=service, request=request))
        events.append(ev.ServiceAnswered(t=0.2, call="set", response=response))
    for number, (shoulder, elbow, error_code, target, elbow_up, frame) in enumerate(answers, start=1):
        request = ComputeIK.Request(elbow_up=elbow_up)
        request.target.header.frame_id = frame
        request.target.point.x, request.target.point.y = target
        response = ComputeIK.Response(error_code=error_code, shoulder=shoulder, elbow=elbow)
        call = f"compute_ik {number}"
        events.append(ev.ServiceCalled(t=number, call=call, service="compute_ik", request=request))
        events.append(ev.ServiceAnswered(t=number + 0.5, call=call, response=response))
    params = {"steps": [], **({"started_with": started_with} if started_with else {})}
    return Transcript.from_events("in_order", params, events)


def answer(shoulder, elbow, *, target=TARGET, elbow_up=False, error_code=1, frame="shoulder"):
    return shoulder, elbow, error_code, target, elbow_up, frame


def require_hit(*answers, **of_the_run):
    return MODEL.reaches_the_point.judge(run(*answers, **of_the_run))


def require_side(*answers):
    return MODEL.bends_the_elbow_as_asked.judge(run(*answers))


@pytest.mark.parametrize("turns", [0, 1, -3])
def test_full_turns_do_not_matter(turns):
    turned = answer(SHOULDER + 2 * math.pi * turns, ELBOW - 2 * math.pi * turns)
    assert require_hit(turned)
    assert require_side(turned)


def test_each_of_the_two_solutions_is_on_its_side():
    above = (DIRECTION + INSIDE, -ELBOW)
    require_hit(answer(*above, elbow_up=True))
    require_side(answer(*above, elbow_up=True))
    with pytest.raises(Failure, match="the elbow is above that line"):
        require_side(answer(*above, elbow_up=False))
    with pytest.raises(Failure, match="the elbow is below that line"):
        require_side(answer(SHOULDER, ELBOW, elbow_up=True))


@pytest.mark.parametrize("shoulder", [math.inf, math.nan])
def test_an_angle_that_is_none_has_no_side(shoulder):
    with pytest.raises(Failure, match="two finite angles"):
        require_side(answer(shoulder, ELBOW, elbow_up=True))


def test_behind_the_shoulder_both_sides_are_accepted():
    for elbow_up in (False, True):
        require_side(answer(math.pi - SHOULDER, -ELBOW, target=(-0.4, 0.3), elbow_up=elbow_up))


def test_an_error_of_two_millimetres_is_too_large():
    with pytest.raises(Failure, match="mm off"):
        require_hit(answer(SHOULDER + 0.004, ELBOW))


@pytest.mark.parametrize(
    ("shoulder", "elbow", "advice"),
    [
        (math.degrees(SHOULDER), math.degrees(ELBOW), "degrees"),
        (SHOULDER, SHOULDER + ELBOW, "relative to the upper arm"),
        (SHOULDER, math.pi - ELBOW, "angle between the links"),
        (SHOULDER, math.pi + ELBOW, "angle between the links"),
        (SHOULDER, -ELBOW, "belong to different solutions"),
        (-SHOULDER, -ELBOW, "count clockwise"),
        (ELBOW, SHOULDER, "are swapped"),
        (math.pi / 2 - DIRECTION - INSIDE, ELBOW, "atan2(y, x)"),
        (SHOULDER + math.pi, ELBOW, "all four quadrants"),
        (round(SHOULDER, 2), round(ELBOW, 2), "leave out round()"),
        (DIRECTION, ELBOW, "The shoulder equals the direction to the target, 0.6435: subtract the angle"),
        (DIRECTION, -ELBOW, "subtract the angle between that direction and the upper arm"),
        (math.nan, ELBOW, "NaN or infinite"),
        (math.inf, -math.inf, "NaN or infinite"),
        (1e308, 1e308, "NaN or infinite"),
        (1e308, -1e308, "Check your angles"),
        (0.0, 0.0, "as in a new response"),
        (1.0, 1.0, "Check your angles"),
    ],
)
def test_the_advice_names_the_mistake(shoulder, elbow, advice):
    assert advice in failure_of(require_hit, answer(shoulder, elbow)).help


def test_an_answer_for_the_default_lengths_is_recognised():
    assert "upper_arm_length" in failure_of(require_hit, answer(SHOULDER, ELBOW), lengths=(0.22, 0.30)).help


@pytest.mark.parametrize(("code", "advice"), [(0, "constants"), (-31, "up to their sum")])
def test_a_code_that_is_none_is_told_from_a_wrong_one(code, advice):
    assert advice in failure_of(require_hit, answer(SHOULDER, ELBOW, error_code=code)).help


def sides(run_below, run_above):
    """Return the advice for angles given with elbow_up false and true."""
    return failure_of(require_side, answer(*run_below), answer(*run_above, elbow_up=True)).help


def test_an_elbow_always_on_one_side_is_distinguished_from_swapped_sides():
    below, above = (SHOULDER, ELBOW), (DIRECTION + INSIDE, -ELBOW)
    assert sides(below, below).startswith(
        "With elbow_up false the elbow was also below: elbow_up has no effect."
    )
    assert sides(above, above).startswith(
        "With elbow_up true the elbow was also above: elbow_up has no effect."
    )
    assert "the opposite effect" in sides(above, below)
    assert require_side(answer(*below), answer(*above, elbow_up=True))


@pytest.mark.parametrize("frame", ["", "l_shoulder"])
def test_only_shoulder_is_the_frame_of_the_arm(frame):
    either = " either" if not frame else ""
    failure = failure_of(MODEL.refuses_other_frames.judge, run(answer(SHOULDER, ELBOW, frame=frame)))
    assert (
        failure.help
        == f"{frame!r} is not 'shoulder'{either}: before computing, return FRAME_TRANSFORM_FAILURE "
        "for every other frame."
    )


@pytest.mark.parametrize(
    ("away", "codes"), [(-0.002, {1}), (-0.0005, {1, -31}), (0.0005, {-31}), (0.002, {-31})]
)
def test_at_a_limit_of_the_reach_either_code_is_right_if_the_hand_is_there(away, codes):
    arm, right = TwoLinkArm(), set()
    farthest = (arm.farthest + away, 0.0)
    bend = math.acos(min(1.0, (farthest[0] ** 2 - 0.30**2 - 0.25**2) / (2 * 0.30 * 0.25)))
    shoulder = -math.atan2(0.25 * math.sin(bend), 0.30 + 0.25 * math.cos(bend))
    for code in (1, -31):
        asked = run(answer(shoulder, bend, target=farthest, error_code=code))
        try:
            MODEL.reaches_the_point.judge(asked)
            MODEL.says_what_is_out_of_reach.judge(asked)
            right.add(code)
        except Failure:
            pass
    assert codes <= right
    assert abs(away) < 0.001 or right == codes


@pytest.mark.parametrize("together", [False, True])
def test_lengths_that_were_accepted_are_used(together):
    with pytest.raises(Failure, match="mm off"):
        require_hit(answer(SHOULDER, ELBOW), lengths=(0.22, 0.30), together=together)
    assert require_hit(answer(SHOULDER, ELBOW), lengths=(0.30, 0.25), together=together)


def test_a_length_that_was_refused_is_not_used():
    assert require_hit(answer(SHOULDER, ELBOW), lengths=(0.22, 0.30), accepted=False)
    assert MODEL.uses_the_lengths_it_accepted.judge(
        run(answer(SHOULDER, ELBOW), lengths=(0.5,), accepted=False)
    )


@pytest.mark.parametrize("length", [0.0, -0.25, math.nan])
def test_with_an_invalid_length_any_answer_is_accepted(length):
    asked = run(answer(1.0, 1.0), lengths=(length,))
    assert MODEL.answers_every_call.judge(asked) == {"with invalid lengths": 1}
    assert not MODEL.reaches_the_point.judge(asked)


def test_a_request_without_an_answer_is_named_by_its_target():
    events = run(answer(0.0, 0.0, target=(0.03, 0.02))).events[:1]
    assert (
        "(0.03, 0.02)"
        in failure_of(
            MODEL.reaches_the_point.judge, Transcript.from_events("in_order", {"steps": []}, events)
        ).expected
    )
