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


def cancel(t, canceling=("goal 1",)):
    name = f"cancel {next(NUMBERS)}"
    return [
        ev.CancelReceived(t=t, cancel=name, action=NAVIGATE, server="server 1", goal="goal 1"),
        ev.CancelReplySent(t=t, cancel=name, return_code=0, canceling=list(canceling)),
    ]


def finished(t, status):
    result = NavigateToPose.Result(error_msg="late" if status == GoalStatus.STATUS_ABORTED else "")
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


NO_NODE = [ev.NodeStarted(t=0.0), *OFFERED, *OVER]
USAGE = ended(0.4, 2, errors=["usage: battery_guard.py"])
ALONE = [*STARTED, *STANDS, *level(0.3, 0.8), *OVER]
REJECTED = [*READY, *goal(2.0)[:1], ev.GoalReplySent(t=2.1, goal="goal 1", accepted=False)]
ABORTED = [*UNDER_WAY, *finished(5.0, GoalStatus.STATUS_ABORTED)]
UNANSWERED = [*READY, *goal(2.0)[:1], *ended(7.2, 1, errors=["no answer"])]
SILENT = [*READY, *goal(2.0), *cancel(7.2), *ended(7.8, 1, errors=["silence"])]
INTERRUPTED = [*UNDER_WAY, ev.NodeSignalled(t=3.0, signal="SIGINT"), *cancel(3.1), *finished(4.1, CANCELED)]
NONSENSE_ALONE = [*STARTED, *OFFERED, *level(0.3, 20.0), *level(0.4, math.nan), *OVER]
AT_LAST = [*NONSENSE_ALONE, *level(3.0, 0.64), *goal(3.2), *finished(5.0, SUCCEEDED)]
STOOD_FIRST = [*DROPPED, *cancel(3.1), *mode(3.6, RobotState.STANDING), *finished(5.6, CANCELED)]
ON_THE_SPOT = [*READY, *goal(2.0), *level(3.0, 0.1), *cancel(3.1), *finished(3.6, CANCELED)]
DEAF = [*DROPPED, *cancel(3.1)]
NEVER_STANDS = [*DROPPED, *cancel(3.1), *finished(3.6, CANCELED)]
REFUSED = [*DROPPED, *cancel(3.1, canceling=())]


def canceled(t):
    return ended(t, 4, "CANCELED")


@pytest.mark.parametrize(
    ("check", "sound", "faulty"),
    [
        (
            "refuses_wrong_arguments",
            [[*NO_NODE, *USAGE]] * 2,
            [[*NO_NODE, *USAGE], [*READY, *ended(1.0, 2, errors=["usage"])]],
        ),
        (
            "gives_up_without_a_server",
            [[*ALONE, *ended(5.7, 1, errors=["nobody"])]],
            [[*ALONE, *ended(1.2, 1, errors=["nobody"])]],
        ),
        (
            "says_how_it_failed",
            [[*REJECTED, *ended(2.3, 2, errors=["rejected"])], [*ABORTED, *ended(5.2, 3, errors=["late"])]],
            [
                [*REJECTED, *ended(2.3, 2, errors=["rejected"])],
                [*ABORTED, *ended(5.2, 3, errors=["ABORTED"])],
            ],
        ),
        ("ctrl_c_cancels_the_goal", [[*INTERRUPTED, *canceled(4.3)]], [[*INTERRUPTED, *ended(4.3, 130)]]),
        (
            "looks_at_the_battery_until_it_sends",
            [[*ALONE, *level(2.0, 0.1), *canceled(2.2)]],
            [[*ALONE, *level(2.0, 0.1), *goal(3.2), *cancel(3.4), *canceled(4.0)]],
        ),
        (
            "waits_for_a_percentage",
            [[*NONSENSE_ALONE, *ended(5.7, 1, errors=["none"])], [*AT_LAST, *ended(5.2, 0, "SUCCEEDED")]],
            [[*NONSENSE_ALONE, *goal(1.0), *ended(5.7, 1)], [*AT_LAST, *ended(5.2, 0, "SUCCEEDED")]],
        ),
        (
            "takes_standing_and_canceled_in_any_order",
            [[*STOOD_FIRST, *canceled(5.8)], [*ON_THE_SPOT, *canceled(3.8)]],
            [[*STOOD_FIRST, *canceled(5.8)], [*ON_THE_SPOT, *canceled(8.7)]],
        ),
        (
            "takes_standing_and_canceled_in_any_order",
            [[*STOOD_FIRST, *canceled(5.8)], [*ON_THE_SPOT, *canceled(3.8)]],
            [[*STOOD_FIRST, *canceled(3.8)], [*ON_THE_SPOT, *canceled(3.8)]],
        ),
        (
            "waits_no_longer_than_5_s",
            [[*DEAF, *canceled(8.2)], [*NEVER_STANDS, *canceled(8.8)]],
            [[*DEAF, *canceled(8.2)], [*NEVER_STANDS, *canceled(16.0)]],
        ),
        (
            "waits_no_longer_than_5_s",
            [[*DEAF, *canceled(8.2)], [*NEVER_STANDS, *canceled(8.8)]],
            [[*DEAF], [*NEVER_STANDS, *canceled(8.8)]],
        ),
        (
            "a_refused_cancel_is_no_end",
            [[*REFUSED, *finished(5.0, SUCCEEDED), *ended(5.2, 0, "SUCCEEDED")]],
            [[*REFUSED, *ended(3.2, 4, "the cancel is refused")]],
        ),
        ("gives_up_in_silence", [UNANSWERED, SILENT], [UNANSWERED, [*READY, *goal(2.0), *ended(7.8, 1)]]),
        (
            "tells_a_cancel_by_another",
            [[*UNDER_WAY, *finished(3.6, CANCELED), *canceled(3.8)]],
            [[*UNDER_WAY, *finished(3.6, CANCELED), *ended(3.8, 3, errors=["ABORTED"])]],
        ),
    ],
)
def test_a_check_tells_a_sound_run_from_a_faulty_one(check, sound, faulty):
    judge(check, *sound)
    failure(check, *faulty)
