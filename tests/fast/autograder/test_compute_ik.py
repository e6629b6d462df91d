"""Angles are judged by where they bring the hand, and a known mistake is called by its name."""

import math

import pytest

from autograder.authoring import events as ev
from autograder.authoring.checks import Failure
from autograder.authoring.transcript import Transcript
from autograder.engine.exercise import exercise_module, load_exercise
from humanoid_interfaces.srv import ComputeIK

JUDGING = exercise_module("compute_ik", "judging")
Reply, require_hit, require_side = JUDGING.Reply, JUDGING.require_hit, JUDGING.require_side
CHECKS = {check.id: check for check in load_exercise("compute_ik", hidden=True).checks}
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


@pytest.mark.parametrize("shoulder", [math.inf, math.nan])
def test_an_angle_that_is_none_has_no_side(shoulder):
    for judged in (
        lambda answer: require_side(answer),
        lambda answer: JUDGING.require_sides([answer, reply(0.1, 0.2)]),
    ):
        with pytest.raises(Failure, match="which is nowhere"):
            judged(reply(shoulder, ELBOW, elbow_up=True))


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
        (round(SHOULDER, 2), round(ELBOW, 2), "leave out round()"),
        (DIRECTION, ELBOW, "The shoulder equals the direction to the target, 0.6435: subtract the angle"),
        (DIRECTION, -ELBOW, "subtract the angle that the bent elbow adds"),
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


def sides(run_below, run_above):
    """Return the advice for angles given with elbow_up false and true."""
    below, above = reply(*run_below), reply(*run_above, elbow_up=True)
    with pytest.raises(Failure) as failure:
        JUDGING.require_sides([below, above])
    return failure.value.help


def test_an_elbow_that_is_always_on_one_side_is_told_from_one_that_is_turned_round():
    below, above = (SHOULDER, ELBOW), (DIRECTION + INSIDE, -ELBOW)
    assert sides(below, below).startswith(
        "With elbow_up false the elbow was also below: elbow_up is not used."
    )
    assert sides(above, above).startswith(
        "With elbow_up true the elbow was also above: elbow_up is not used."
    )
    assert "the wrong way round" in sides(above, below)
    JUDGING.require_sides([reply(*below), reply(*above, elbow_up=True)])


def refused_frame(frame):
    """Return the advice where only one frame but the arm's is taken for the arm's."""
    events = []
    for name, asked_in in (("in shoulder 1", "shoulder"), ("in others 1", frame)):
        request = ComputeIK.Request()
        request.target.header.frame_id = asked_in
        events.append(ev.ServiceCalled(t=0.5, call=name, service="compute_ik", request=request))
        events.append(ev.ServiceAnswered(t=1.0, call=name, response=ComputeIK.Response(error_code=1)))
    questions = {"in shoulder": [{}], "in others": [{}]}
    with pytest.raises(Failure) as failure:
        CHECKS["refuses_other_frames"].run([Transcript.from_events("ask", {"questions": questions}, events)])
    return failure.value.help


def test_an_empty_frame_is_another_frame_like_any():
    assert refused_frame("") == "'' is not 'shoulder' either: refuse everything else, before computing."
    assert (
        refused_frame("l_shoulder")
        == "'l_shoulder' is not 'shoulder': refuse everything else, before computing."
    )
