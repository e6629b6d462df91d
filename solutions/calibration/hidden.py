"""What only the instructor's grading checks."""

from __future__ import annotations

import random

from autograder.authoring import events as ev
from autograder.authoring import standard_hidden
from autograder.authoring.checks import RESTING, Scenario, check
from autograder.authoring.missing import unseen
from autograder.authoring.robot_topic import DELIVERY
from autograder.authoring.transcript import Transcript

from .checks import (
    ASKS,
    BIASES,
    GROUPS,
    KNOWS_NOTHING,
    SILENT_ROBOT,
    SILENT_STATUS,
    WAITS,
    calibrates,
    fails_when_it_begins_to_walk,
    fails_without_samples,
    keeps_its_heartbeat,
    lives_while_it_waits,
    publishes_the_bias,
    refuses_a_second_caller,
    refuses_before_the_first_state,
    refuses_without_an_answer,
)
from .heartbeat import require_heartbeat
from .judging import (
    ASKING,
    COLLECTING,
    LATE,
    require_bias_published,
    require_calibrated,
    require_imu_lost,
    require_refused,
    require_refused_meanwhile,
    require_walk_begun_meanwhile,
    status_request,
)


def _bias(random: random.Random) -> list[float]:
    """Return a bias (rad/s) no axis of which is near zero."""
    return [round(random.choice((-1, 1)) * random.uniform(0.004, 0.014), 4) for _ in "xyz"]


def _two_biases(random: random.Random) -> dict:
    """Return two that are 0.004 rad/s apart at least, about every axis."""
    first = _bias(random)
    return {"biases": [first, [round(-value, 4) for value in first]]}


def _slow_status(random: random.Random) -> dict:
    return {"status_after": round(random.uniform(1.1, 1.4), 2), "bias": _bias(random)}


def _a_few_steps(random: random.Random) -> dict:
    """Turning on the spot or backwards for two steps (m/s, m/s, rad/s)."""
    velocity = random.choice(([0.0, 0.0, 0.35], [0.0, 0.0, -0.35], [-0.15, 0.0, 0.0]))
    return {"begin": round(random.uniform(0.1, 0.4), 2), "velocity": velocity, "steps": 2}


ANY_BIAS_TWICE = Scenario("calibrate_twice", _two_biases, robot=RESTING)
SLOW_STATUS = Scenario("calibrate_with_slow_status", _slow_status, robot=RESTING)
LATE_ANSWER = Scenario("answer_the_request_before", {"status_after": 3.0}, robot=RESTING)
NO_STATUS = Scenario("calibrate_without_status", robot=RESTING)
TWO_WHILE_ASKING = Scenario("calibrate_from_two_clients", {"apart": 0.3, "status_after": 1.3}, robot=RESTING)
A_FEW_STEPS = Scenario("begin_to_walk_meanwhile", _a_few_steps)
FEW_SAMPLES = Scenario("lose_the_imu", {"begin": 1.3}, robot=RESTING)
ENOUGH_SAMPLES = Scenario("lose_the_imu", {"begin": 2.5}, robot=RESTING)
OTHER_NAMESPACE = Scenario("calibrate_twice", {"biases": BIASES[:1]}, robot=RESTING, namespace="/lab_7/robot")


@check(points=2, on=ANY_BIAS_TWICE, needs=publishes_the_bias, see=WAITS)
def calibrates_afresh(run: Transcript) -> None:
    """A second calibration is made of its own samples, whatever the bias"""
    require_calibrated(run.call("first"))
    second = run.call("second")
    require_calibrated(second)
    require_bias_published(second)


@check(points=1, on=SLOW_STATUS, needs=calibrates, see=ASKS)
def waits_for_a_slow_status(run: Transcript) -> None:
    """When get_status takes more than a second, it still waits, and then collects for 3 s"""
    call = run.call("slow status")
    request = status_request(call)
    if request is not None and request.reply is None and request.received.t + ASKING < run.end:
        raise unseen(run, "get_status did not answer")
    require_calibrated(call)


@check(points=1, on=SILENT_STATUS, needs=[calibrates_afresh, refuses_without_an_answer], see=ASKS)
def recovers_when_status_answers(run: Transcript) -> None:
    """After a refusal it can calibrate again"""
    require_calibrated(run.call("status is back"))


@check(
    points=1,
    on=LATE_ANSWER,
    needs=[calibrates, refuses_without_an_answer, waits_for_a_slow_status],
    see="03b_clients_in_bad_company#late-fix-run",
)
def takes_no_answer_for_another(run: Transcript) -> None:
    """A late answer of get_status is not taken for the answer to the next request"""
    late, other = run.call("late answer"), run.call("answer of another")
    for call in (late, other):
        require_refused(
            call,
            because="its own request to get_status had no answer within 2 s",
            within=ASKING + LATE,
            help="Look at the future of this request only; forget it with remove_pending_request after 2 s.",
        )
    replies = [request.reply.t for request in run.requests("get_status") if request.reply]
    if not any(other.sent.t < t < other.sent.t + ASKING for t in replies):
        raise unseen(run, "the late answer did not come during the second calibration")


@check(points=1, on=NO_STATUS, needs=[refuses_without_an_answer, lives_while_it_waits], see=ASKS)
def refuses_without_a_server(run: Transcript) -> None:
    """When nobody offers get_status, it refuses within 2 s, and heartbeat goes on"""
    if run.all(ev.ServiceOffered):
        raise unseen(run, "somebody offered get_status")
    call = run.call("nobody offers get_status")
    require_refused(
        call,
        because="nobody offers get_status",
        within=ASKING + LATE,
        help="Give wait_for_service a timeout_sec, or leave it out: the limit of 2 s to the answer covers it.",
    )
    require_heartbeat(run, call, "while it looked for get_status")


@check(points=1, on=TWO_WHILE_ASKING, needs=[refuses_a_second_caller, waits_for_a_slow_status], see=GROUPS)
def is_busy_while_it_asks(run: Transcript) -> None:
    """A calibration has begun as soon as it is asked for, also while it waits for get_status"""
    first, second = run.call("first caller"), run.call("second caller")
    request = status_request(first)
    if request is None or (request.reply and request.reply.t < second.sent.t + DELIVERY / 4):
        raise unseen(run, "the second request did not come while get_status was asked")
    require_refused_meanwhile(first, second)
    require_calibrated(first)


@check(points=1, on=A_FEW_STEPS, needs=fails_when_it_begins_to_walk, see="05_executors#why")
def fails_after_a_few_steps(run: Transcript) -> None:
    """A robot that walked for a moment, and stands again at the end, has walked"""
    call = run.call("it begins to walk")
    require_walk_begun_meanwhile(call)
    run.told("walk", before=call.sent.t + COLLECTING, velocity=[0.0, 0.0, 0.0])
    require_refused(
        call,
        because="the robot walked while the samples were collected",
        within=COLLECTING + LATE,
        help="Remember in the callback of robot_state that it walked: at the end it may stand again.",
    )


@check(points=1, on=FEW_SAMPLES, needs=fails_without_samples, see=KNOWS_NOTHING)
def fails_with_few_samples(run: Transcript) -> None:
    """Some samples are not enough: with fewer than 100 the calibration fails"""
    call = run.call("the imu falls silent")
    require_imu_lost(call, fewest=30, most=90)
    require_refused(
        call,
        because="the imu fell silent after about 65 samples",
        within=COLLECTING + LATE,
        help="Fail when there are fewer than 100 samples, not only when there is none.",
    )


@check(points=1, on=ENOUGH_SAMPLES, needs=calibrates, see=WAITS)
def is_content_with_enough_samples(run: Transcript) -> None:
    """100 samples are enough, also when some are missing"""
    call = run.call("the imu falls silent")
    require_imu_lost(call, fewest=112, most=134)
    require_calibrated(call)


@check(
    points=1,
    on=SILENT_ROBOT,
    needs=[calibrates, refuses_before_the_first_state],
    see=KNOWS_NOTHING,
)
def recovers_when_the_robot_speaks(run: Transcript) -> None:
    """Once the first robot_state has come, it calibrates"""
    call = run.call("after the first state")
    run.told("robot_state", before=call.sent.t - DELIVERY, published=True)
    require_calibrated(call)


def _calibrates(run: Transcript) -> None:
    call = run.call("first")
    require_calibrated(call)
    require_bias_published(call)
    require_heartbeat(run, call, "while calibrate_imu was at work")


works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "calibrates", _calibrates, points=1, on=OTHER_NAMESPACE, needs=[publishes_the_bias, keeps_its_heartbeat]
)
