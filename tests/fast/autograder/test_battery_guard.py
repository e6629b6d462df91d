"""How a run of the battery guard is judged, on records made by hand: one sound client and its near misses."""

import math
from itertools import count

import pytest
from action_msgs.msg import GoalStatus
from sensor_msgs.msg import BatteryState

from autograder.authoring import events as ev
from autograder.authoring.checks import CannotBeJudged, Failure
from autograder.authoring.transcript import Transcript
from autograder.engine.exercise import load_exercise
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState

CHECKS = {check.id: check for check in load_exercise("battery_guard", hidden=True).checks}
NAVIGATE = "navigate_to_pose"
SUCCEEDED, CANCELED = GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_CANCELED
NUMBERS = count(1)
STARTED = [ev.NodeStarted(t=0.0), ev.NodeReady(t=0.5, waited=0.5)]
OFFERED = [ev.ActionOffered(t=0.1, action=NAVIGATE, server="server 1", type="NavigateToPose")]
OVER = [ev.ScenarioEnded(t=30.0)]
PARAMS = {"arguments": ["1.5", "-0.5", "0.4"]}


def level(t, percentage, subscriptions=1):
    message = BatteryState(percentage=percentage)
    return [ev.MessagePublished(t=t, topic="battery_state", message=message, subscriptions=subscriptions)]


def mode(t, mode):
    return [ev.MessagePublished(t=t, topic="robot_state", message=RobotState(mode=mode), subscriptions=1)]


def goal(t, x=1.5, y=-0.5, yaw=0.4, frame="odom", accepted=0.1):
    message = NavigateToPose.Goal()
    message.pose.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.z = math.sin(yaw / 2)
    message.pose.pose.orientation.w = math.cos(yaw / 2)
    received = ev.GoalReceived(t=t, goal="goal 1", action=NAVIGATE, server="server 1", message=message)
    return [received, ev.GoalReplySent(t=t + accepted, goal="goal 1", accepted=True)]


def cancel(t):
    name = f"cancel {next(NUMBERS)}"
    return [
        ev.CancelReceived(t=t, cancel=name, action=NAVIGATE, server="server 1", goal="goal 1"),
        ev.CancelReplySent(t=t, cancel=name, return_code=0, canceling=["goal 1"]),
    ]


def finished(t, status):
    result = NavigateToPose.Result()
    return [
        ev.GoalFinished(t=t, goal="goal 1", status=status, result=result),
        ev.ResultSent(t=t, goal="goal 1"),
    ]


def ended(t, status, *lines, errors=()):
    said = [ev.NodeOutput(t=t - 0.01, stream="stdout", text=line) for line in lines]
    complained = [ev.NodeOutput(t=t - 0.01, stream="stderr", text=line) for line in errors]
    return [*said, *complained, ev.NodeExited(t=t, returncode=status)]


STANDS, WALKS = mode(0.2, RobotState.STANDING), mode(2.5, RobotState.WALKING)
READY = [*STARTED, *OFFERED, *STANDS, *level(0.3, 0.8), *OVER]
UNDER_WAY = [*READY, *goal(2.0), *WALKS]
DROPPED = [*UNDER_WAY, *level(3.0, 0.19)]
STOOD = mode(6.0, RobotState.STANDING)
CALLED_OFF = [*DROPPED, *cancel(3.1), *finished(3.7, CANCELED), *STOOD]
ALL_WELL = [*UNDER_WAY, *finished(5.0, SUCCEEDED)]
NAN_ON_THE_WAY = [*UNDER_WAY, *level(3.0, math.nan), *level(3.3, 20.0), *finished(5.0, SUCCEEDED)]
WARNED = "[WARN] [1.0] [battery_guard]: ignored: a percentage of nan"


def judge(check, *records):
    CHECKS[check].run([Transcript.from_events("any", PARAMS, record) for record in records])


def failure(check, *records):
    with pytest.raises(Failure) as caught:
        judge(check, *records)
    return caught.value


@pytest.mark.parametrize(
    ("check", "record"),
    [
        ("sends_the_goal", ALL_WELL),
        ("says_how_it_succeeded", [*ALL_WELL, *ended(5.2, 0, "SUCCEEDED")]),
        (
            "does_not_set_out_on_a_low_battery",
            [*STARTED, *OFFERED, *level(0.1, 0.12), *ended(1.0, 4, "not sent: the battery is at 0.12")],
        ),
        (
            "does_not_set_out_without_a_battery_state",
            [*STARTED, *OFFERED, *ended(5.6, 1, errors=["none came"])],
        ),
        ("cancels_when_the_battery_drops", CALLED_OFF),
        ("waits_until_the_robot_stands", [*CALLED_OFF, *ended(6.2, 4, "CANCELED: low")]),
        ("ignores_what_is_no_percentage", [*NAN_ON_THE_WAY, *ended(5.2, 0, "SUCCEEDED", errors=[WARNED])]),
        (
            "cancels_right_after_the_acceptance",
            [*READY, *goal(2.0, accepted=2.0), *level(2.5, 0.1), *cancel(4.1)],
        ),
    ],
)
def test_a_sound_run_passes(check, record):
    judge(check, record)


@pytest.mark.parametrize(
    ("check", "record", "told"),
    [
        ("sends_the_goal", [*READY, *goal(2.0, frame="")], "frame_id"),
        ("sends_the_goal", [*READY, *goal(2.0, yaw=0.0)], "math.sin(yaw / 2)"),
        ("does_not_set_out_on_a_low_battery", [*DROPPED, *ended(5.0, 4, "battery")], "before you send"),
        (
            "does_not_set_out_on_a_low_battery",
            [*STARTED, *OFFERED, *level(0.1, 0.12, 0), *ended(6.0, 1, errors=["none"])],
            "TRANSIENT_LOCAL",
        ),
        (
            "does_not_set_out_without_a_battery_state",
            [*STARTED, *OFFERED, *ended(0.9, 1, errors=["none came"])],
            "One spin is not enough",
        ),
        ("cancels_when_the_battery_drops", DROPPED, "while you wait for the result"),
        ("cancels_when_the_battery_drops", [*CALLED_OFF, *cancel(3.3)], "Remember that you have asked"),
        ("cancels_when_the_battery_drops", [*DROPPED, *cancel(2.8)], "Cancel only for"),
        (
            "cancels_when_the_battery_drops",
            [*UNDER_WAY, *level(3.0, 0.19, subscriptions=0)],
            "create_subscription",
        ),
        ("waits_until_the_robot_stands", [*CALLED_OFF, *ended(3.8, 4, "CANCELED")], "what the legs do"),
        ("waits_until_the_robot_stands", [*CALLED_OFF, *ended(10.9, 4, "CANCELED")], "last message"),
        (
            "ignores_what_is_no_percentage",
            [*UNDER_WAY, *level(3.0, 15.0), *cancel(3.1), *finished(3.7, CANCELED)],
            "counts to 100",
        ),
        (
            "ignores_what_is_no_percentage",
            [*UNDER_WAY, *level(3.0, math.nan), *cancel(3.1), *finished(3.7, CANCELED)],
            "neither low nor high",
        ),
        ("ignores_what_is_no_percentage", [*NAN_ON_THE_WAY, *ended(5.2, 0, "SUCCEEDED")], "once=True"),
        (
            "ignores_what_is_no_percentage",
            [*NAN_ON_THE_WAY, *ended(5.2, 0, "SUCCEEDED", errors=[WARNED, WARNED])],
            "once=True",
        ),
        (
            "cancels_right_after_the_acceptance",
            [*READY, *goal(2.0, accepted=2.0), *level(2.5, 0.1)],
            "remember that the battery is low",
        ),
    ],
)
def test_a_near_miss_is_told_its_next_step(check, record, told):
    assert told in failure(check, record).help


def test_success_wins_only_if_the_status_is_looked_at():
    in_vain = [*DROPPED, *cancel(3.1), *finished(5.0, SUCCEEDED)]
    too_late = [
        *UNDER_WAY,
        *finished(2.9, SUCCEEDED)[:1],
        *level(3.0, 0.1),
        ev.ResultSent(t=5.0, goal="goal 1"),
    ]
    well, badly = ended(5.2, 0, "SUCCEEDED"), ended(5.2, 4, "CANCELED")
    judge("success_wins_the_race", [*in_vain, *well], [*too_late, *well])
    for records in (([*in_vain, *badly], [*too_late, *well]), ([*in_vain, *well], [*too_late, *badly])):
        assert "response.status" in failure("success_wins_the_race", *records).help


@pytest.mark.parametrize("limit", [0.2, 0.2001])
def test_the_limit_as_a_float32_is_not_low(limit):
    well = ended(5.2, 0, "SUCCEEDED")
    at_it = [*STARTED, *OFFERED, *level(0.3, limit), *goal(2.0), *finished(5.0, SUCCEEDED), *well]
    down_to_it = [*UNDER_WAY, *level(3.0, limit), *finished(5.0, SUCCEEDED), *well]
    below = [*UNDER_WAY, *level(3.0, 0.1999), *cancel(3.1)]
    empty = [*UNDER_WAY, *level(3.0, 0.0), *cancel(3.1)]
    judge("compares_with_the_limit_exactly", at_it, down_to_it, below, empty)
    hasty = [*UNDER_WAY, *level(3.0, limit), *cancel(3.1), *finished(3.7, CANCELED)]
    told = failure("compares_with_the_limit_exactly", at_it, hasty, below, empty)
    assert "0.200000003" in told.help
    blind = [*UNDER_WAY, *level(3.0, 0.0)]
    assert "empty battery" in failure("compares_with_the_limit_exactly", at_it, down_to_it, below, blind).help


@pytest.mark.parametrize(
    ("check", "record"),
    [
        ("sends_the_goal", [*STARTED, *OFFERED, *goal(2.0), *OVER]),
        ("cancels_when_the_battery_drops", [*UNDER_WAY, *cancel(3.1)]),
        ("ignores_what_is_no_percentage", [*ALL_WELL, *ended(5.2, 0, "SUCCEEDED", errors=[WARNED])]),
        ("looks_at_the_battery_until_it_sends", [*READY, *level(3.0, 0.1)]),
        ("waits_until_the_robot_stands", [*DROPPED[: -len(WALKS)], *cancel(3.1), *finished(3.7, CANCELED)]),
    ],
)
def test_without_its_stimulus_nothing_passes(check, record):
    with pytest.raises((CannotBeJudged, Failure)):
        judge(check, record)
