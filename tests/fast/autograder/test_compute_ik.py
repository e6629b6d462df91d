"""Angles are judged by where they bring the hand, and a known mistake is called by its name."""

import math

import pytest

from autograder.authoring import events as ev
from autograder.authoring.checks import Failure
from autograder.authoring.transcript import Transcript
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.srv import ComputeIK

JUDGING = exercise_module("compute_ik", "judging")
Reply, require_hit, require_side = JUDGING.Reply, JUDGING.require_hit, JUDGING.require_side
TwoLinkArm = exercise_module("compute_ik", "two_link_arm").TwoLinkArm
TARGET = (0.4, 0.3)
SHOULDER, ELBOW = math.radians(14.5383), math.radians(49.4584)  # the elbow below
DIRECTION = math.atan2(TARGET[1], TARGET[0])
INSIDE = DIRECTION - SHOULDER  # the triangle's angle at the shoulder


def reply(shoulder, elbow, *, target=TARGET, elbow_up=False, error_code=1):
    request = ComputeIK.Request(elbow_up=elbow_up)
    request.target.header.frame_id = "shoulder"
    request.target.point.x, request.target.point.y = target
    response = ComputeIK.Response(error_code=error_code, shoulder=shoulder, elbow=elbow)
    asked = ev.ServiceCalled(t=0.5, call="ask", service="compute_ik", request=request)
    answered = ev.ServiceAnswered(t=1.0, call="ask", response=response)
    return Reply(Transcript.from_events("ask", {}, [asked, answered]).call("ask"))


@pytest.mark.parametrize("turns", [0, 1, -3])
def test_full_turns_do_not_matter(turns):
    answer = reply(SHOULDER + 2 * math.pi * turns, ELBOW - 2 * math.pi * turns)
    require_hit(answer)
    require_side(answer)


def test_each_of_the_two_solutions_is_on_its_side():
    above = (DIRECTION + INSIDE, -ELBOW)
    require_hit(reply(*above, elbow_up=True))
    require_side(reply(*above, elbow_up=True))
    with pytest.raises(Failure, match="the elbow is above it"):
        require_side(reply(*above, elbow_up=False))
    with pytest.raises(Failure, match="the elbow is below it"):
        require_side(reply(SHOULDER, ELBOW, elbow_up=True))


def test_behind_the_shoulder_either_side_will_do():
    for elbow_up in (False, True):
        require_side(reply(math.pi - SHOULDER, -ELBOW, target=(-0.4, 0.3), elbow_up=elbow_up))


def test_two_millimetres_are_too_many():
    with pytest.raises(Failure, match="mm off"):
        require_hit(reply(SHOULDER + 0.004, ELBOW))


@pytest.mark.parametrize(
    ("shoulder", "elbow", "advice"),
    [
        (math.degrees(SHOULDER), math.degrees(ELBOW), "degrees"),
        (SHOULDER, SHOULDER + ELBOW, "counted from the upper arm"),
        (SHOULDER, math.pi - ELBOW, "angle between the links"),
        (SHOULDER, math.pi + ELBOW, "angle between the links"),
        (SHOULDER, -ELBOW, "belong to different sides"),
        (-SHOULDER, -ELBOW, "count clockwise"),
        (ELBOW, SHOULDER, "exchanged in the response"),
        (math.pi / 2 - DIRECTION - INSIDE, ELBOW, "atan2(y, x)"),
        (SHOULDER + math.pi, ELBOW, "all four quadrants"),
        (math.nan, ELBOW, "not a number"),
        (math.inf, -math.inf, "not a number"),
        (1e308, 1e308, "not a number"),
        (1e308, -1e308, "Put the angles back in"),
        (0.0, 0.0, "as in a new response"),
        (1.0, 1.0, "Put the angles back in"),
    ],
)
def test_the_advice_names_the_mistake(shoulder, elbow, advice):
    with pytest.raises(Failure) as failure:
        require_hit(reply(shoulder, elbow))
    assert advice in failure.value.help


def test_an_answer_for_the_default_lengths_is_recognised():
    with pytest.raises(Failure) as failure:
        require_hit(reply(SHOULDER, ELBOW), TwoLinkArm(0.22, 0.30))
    assert "upper_arm_length" in failure.value.help


@pytest.mark.parametrize(("code", "advice"), [(0, "constants"), (-31, "farthest")])
def test_a_code_that_is_none_is_told_from_a_wrong_one(code, advice):
    with pytest.raises(Failure) as failure:
        require_hit(reply(SHOULDER, ELBOW, error_code=code))
    assert advice in failure.value.help
