"""The checks of the battery guard on records made by hand: correct clients and slightly faulty ones."""

import math
from itertools import count

import pytest
from action_msgs.msg import GoalStatus
from sensor_msgs.msg import BatteryState

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, Failure
from autograder.engine.exercise import load_exercise
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from records import failure_of

CHECKS = {check.id: check for check in load_exercise("battery_guard", hidden=True).checks}
NAVIGATE = "navigate_to_pose"
SUCCEEDED, CANCELED, ABORTED = (
    GoalStatus.STATUS_SUCCEEDED,
    GoalStatus.STATUS_CANCELED,
    GoalStatus.STATUS_ABORTED,
)
NUMBERS = count(1)


def level(t, percentage, subscriptions=1):
    message = BatteryState(percentage=percentage)
    return [ev.MessagePublished(t=t, topic="battery_state", message=message, subscriptions=subscriptions)]


def mode(t, mode):
    return [ev.MessagePublished(t=t, topic="robot_state", message=RobotState(mode=mode), subscriptions=1)]


def goal(t, x=1.5, y=-0.5, yaw=0.4, frame="odom", after=0.1, accepted=True):
    message = NavigateToPose.Goal()
    message.pose.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.z = math.sin(yaw / 2)
    message.pose.pose.orientation.w = math.cos(yaw / 2)
    received = ev.GoalReceived(t=t, goal="goal 1", action=NAVIGATE, server="server 1", message=message)
    return [received, ev.GoalReplySent(t=t + after, goal="goal 1", accepted=accepted)]


def feedback(*times):
    return [ev.FeedbackSent(t=t, goal="goal 1", feedback=NavigateToPose.Feedback()) for t in times]


def cancel(t, canceling=("goal 1",)):
    name = f"cancel {next(NUMBERS)}"
    return [
        ev.CancelReceived(t=t, cancel=name, action=NAVIGATE, server="server 1", goal="goal 1"),
        ev.CancelReplySent(t=t, cancel=name, return_code=0, canceling=list(canceling)),
    ]


def finished(t, status, result_after=0.0):
    result = NavigateToPose.Result(error_msg="late" if status == ABORTED else "")
    return [
        ev.GoalFinished(t=t, goal="goal 1", status=status, result=result),
        ev.ResultSent(t=t + result_after, goal="goal 1"),
    ]


def ended(t, status, *lines, errors=()):
    said = [ev.NodeOutput(t=t - 0.01, stream="stdout", text=line) for line in lines]
    complained = [ev.NodeOutput(t=t - 0.01, stream="stderr", text=line) for line in errors]
    return [*said, *complained, ev.NodeExited(t=t, returncode=status)]


STARTED = [ev.NodeStarted(t=0.0), ev.NodeReady(t=0.5, waited=0.5), ev.ScenarioEnded(t=30.0)]
OFFERED = [ev.ActionOffered(t=0.1, action=NAVIGATE, server="server 1", type="NavigateToPose")]
STANDS, WALKS = mode(0.2, RobotState.STANDING), mode(2.5, RobotState.WALKING)
ALONE = [*STARTED, *STANDS, *level(0.3, 0.8)]
UNKNOWN = [*STARTED, *OFFERED, *STANDS]
READY = [*UNKNOWN, *level(0.3, 0.8)]
UNDER_WAY = [*READY, *goal(2.0), *WALKS, *feedback(*(2.2 + 0.2 * n for n in range(80)))]
DROPPED = [*UNDER_WAY, *level(3.0, 0.19)]
ASKED = [*DROPPED, *cancel(3.1)]
CALLED_OFF = [*ASKED, *finished(3.7, CANCELED), *mode(6.0, RobotState.STANDING)]
ALL_WELL = [*UNDER_WAY, *finished(5.0, SUCCEEDED)]
NAN_ON_THE_WAY = [*UNDER_WAY, *level(3.0, math.nan), *level(3.3, 20.0), *finished(5.0, SUCCEEDED)]
WARNED = "[WARN] [1.0] [battery_guard]: ignored: a percentage of nan"
EARLY = [*READY, *goal(2.0, after=2.0), *feedback(4.2, 4.4, 4.6, 6.0, 8.0, 10.0), *level(2.5, 0.1)]
PRESSED = [*UNDER_WAY, ev.NodeSignalled(t=3.0, signal="SIGINT")]
INTERRUPTED = [*PRESSED, *cancel(3.1)]
NONSENSE = [*STARTED, *OFFERED, *STANDS, *level(0.3, 20.0), *level(0.6, math.nan)]
LATE_RESULT = [*UNDER_WAY, *finished(2.9, SUCCEEDED, 2.1), *level(3.0, 0.1)]
SILENT = [*READY, *goal(2.0)]


def judge(check, record, *, arguments=("1.5", "-0.5", "0.4")):
    kinds = {type(event) for event in record}
    offered = {"ends_after": None, "cancel": {"ends_after": None}}
    if ev.GoalReceived in kinds and ev.GoalReplySent not in kinds:
        offered["accepted"] = None
    if any(isinstance(event, ev.GoalReplySent) and not event.accepted for event in record):
        offered["accepted"] = False
    server = offered if ev.ActionOffered in kinds else None
    params = {"arguments": arguments, "server": server, "battery": None, "steps": []}
    CHECKS[check].judge(Transcript.from_events("any", params, record))


def canceled(t):
    return ended(t, 4, "CANCELED")


def succeeded(t):
    return ended(t, 0, "SUCCEEDED")


@pytest.mark.parametrize(
    ("check", "record"),
    [
        ("sends_the_goal", ALL_WELL),
        ("says_how_it_succeeded", [*ALL_WELL, *succeeded(5.2)]),
        ("gives_up_without_a_server", [*ALONE, *ended(5.7, 1, errors=["nobody"])]),
        (
            "says_how_it_failed",
            [*READY, *goal(2.0, accepted=False), *ended(2.3, 2, errors=["rejected"])],
        ),
        (
            "says_how_it_failed",
            [*UNDER_WAY, *finished(5.0, ABORTED), *ended(5.2, 3, errors=["ABORTED: late"])],
        ),
        (
            "does_not_set_out_on_a_low_battery",
            [*UNKNOWN, *level(0.1, 0.12), *ended(1.0, 4, "not sent: the battery is at 0.12")],
        ),
        ("does_not_set_out_without_a_battery_state", [*UNKNOWN, *ended(5.6, 1, errors=["none came"])]),
        ("cancels_when_the_battery_drops", CALLED_OFF),
        ("waits_until_the_robot_stands", [*CALLED_OFF, *ended(6.2, 4, "CANCELED: low")]),
        ("ignores_what_is_no_percentage", [*NAN_ON_THE_WAY, *ended(5.2, 0, "SUCCEEDED", errors=[WARNED])]),
        ("ctrl_c_cancels_the_goal", [*INTERRUPTED, *finished(4.1, CANCELED), *canceled(4.3)]),
        ("compares_with_the_limit_exactly", [*ALL_WELL, *level(2.5, 0.2), *level(2.8, 0.2001)]),
        ("compares_with_the_limit_exactly", [*UNDER_WAY, *level(3.0, 0.1999), *cancel(3.1)]),
        ("cancels_right_after_the_acceptance", [*EARLY, *cancel(4.1)]),
        ("success_wins_the_race", [*ASKED, *finished(5.0, SUCCEEDED), *succeeded(5.2)]),
        ("success_wins_the_race", [*LATE_RESULT, *succeeded(5.2)]),
        (
            "success_wins_the_race",
            [*INTERRUPTED, *finished(5.0, ABORTED), *ended(5.2, 3, errors=["ABORTED: late"])],
        ),
        ("looks_at_the_battery_until_it_sends", [*ALONE, *level(2.0, 0.1), *ended(2.2, 4, "battery 10 %")]),
        ("takes_standing_and_canceled_in_any_order", [*CALLED_OFF, *canceled(6.2)]),
        ("waits_no_longer_than_5_s", [*ASKED, *mode(3.6, RobotState.STANDING), *ended(8.2, 4, "no end")]),
        ("waits_no_longer_than_5_s", [*ASKED, *finished(3.6, CANCELED), *canceled(8.8)]),
        ("waits_no_longer_than_5_s", [*INTERRUPTED, *ended(8.2, 4, "no end")]),
        ("waits_for_a_percentage", [*NONSENSE, *ended(5.7, 1, errors=[WARNED, "none"])]),
        (
            "waits_for_a_percentage",
            [
                *(*NONSENSE, *level(3.0, 0.64), *goal(3.2), *finished(5.0, SUCCEEDED)),
                *ended(5.2, 0, "SUCCEEDED", errors=[WARNED]),
            ],
        ),
        ("gives_up_in_silence", [*READY, *goal(2.0)[:1], *ended(7.2, 1, errors=["no answer"])]),
        ("gives_up_in_silence", [*SILENT, *cancel(7.2), *ended(7.8, 1, errors=["silence"])]),
        ("tells_a_cancel_by_another", [*UNDER_WAY, *finished(3.6, CANCELED), *canceled(3.8)]),
        (
            "a_refused_cancel_is_no_end",
            [*DROPPED, *cancel(3.1, ()), *finished(5.0, SUCCEEDED), *succeeded(5.2)],
        ),
    ],
)
def test_a_correct_run_passes(check, record):
    judge(check, record)


@pytest.mark.parametrize(
    ("check", "record", "told"),
    [
        ("sends_the_goal", [*READY, *goal(2.0, frame="")], "frame_id"),
        ("sends_the_goal", [*READY, *goal(2.0, yaw=0.0)], "math.sin(yaw / 2)"),
        ("gives_up_without_a_server", [*ALONE, *ended(1.2, 1, errors=["nobody"])], "server_is_ready()"),
        (
            "says_how_it_failed",
            [*UNDER_WAY, *finished(5.0, ABORTED), *ended(5.2, 3, errors=["x"])],
            "error_msg",
        ),
        (
            "does_not_set_out_on_a_low_battery",
            [*UNKNOWN, *level(0.1, 0.12), *goal(2.0), *ended(5.0, 4, "battery")],
            "before you send",
        ),
        (
            "does_not_set_out_on_a_low_battery",
            [*UNKNOWN, *level(0.0, 0.12, 0), *ended(6.0, 1, errors=["none"])],
            "TRANSIENT_LOCAL",
        ),
        (
            "does_not_set_out_without_a_battery_state",
            [*UNKNOWN, *ended(0.9, 1, errors=["none came"])],
            "A single spin is not enough",
        ),
        ("cancels_when_the_battery_drops", DROPPED, "while you wait for the result"),
        ("cancels_when_the_battery_drops", [*DROPPED, *cancel(5.3)], "while you wait for the result"),
        (
            "cancels_when_the_battery_drops",
            [*CALLED_OFF, *cancel(3.3)],
            "Remember that you have sent a request",
        ),
        ("cancels_when_the_battery_drops", [*DROPPED, *cancel(2.8)], "Cancel only at"),
        ("cancels_when_the_battery_drops", [*UNDER_WAY, *level(3.0, 0.19, 0)], "create_subscription"),
        (
            "waits_until_the_robot_stands",
            [*CALLED_OFF, *canceled(3.8)],
            "does not mean that the robot stands",
        ),
        ("waits_until_the_robot_stands", [*CALLED_OFF, *canceled(10.9)], "last message"),
        ("waits_until_the_robot_stands", [*CALLED_OFF, *ended(6.2, 4, "low battery")], "CANCELED"),
        (
            "ignores_what_is_no_percentage",
            [*UNDER_WAY, *level(3.0, 15.0), *cancel(3.1), *finished(3.7, CANCELED)],
            "values up to 100",
        ),
        (
            "ignores_what_is_no_percentage",
            [*UNDER_WAY, *level(3.0, math.nan), *cancel(3.1), *finished(3.7, CANCELED)],
            "neither low nor high",
        ),
        ("ignores_what_is_no_percentage", [*NAN_ON_THE_WAY, *succeeded(5.2)], "once=True"),
        (
            "ignores_what_is_no_percentage",
            [*NAN_ON_THE_WAY, *ended(5.2, 0, "SUCCEEDED", errors=[WARNED, WARNED])],
            "once=True",
        ),
        ("ctrl_c_cancels_the_goal", PRESSED, "SignalHandlerOptions.NO"),
        ("ctrl_c_cancels_the_goal", [*INTERRUPTED, *finished(4.1, CANCELED), *ended(4.3, 130)], "status"),
        ("compares_with_the_limit_exactly", [*UNDER_WAY, *level(3.0, 0.2), *cancel(3.1)], "0.200000003"),
        ("compares_with_the_limit_exactly", [*UNDER_WAY, *level(3.0, 0.1999)], "Rounding"),
        ("compares_with_the_limit_exactly", [*UNDER_WAY, *level(3.0, 0.0)], "empty battery"),
        (
            "compares_with_the_limit_exactly",
            [*UNKNOWN, *level(0.3, 0.2), *ended(1.0, 4, "low")],
            "0.200000003",
        ),
        ("cancels_right_after_the_acceptance", EARLY, "before you had the goal handle"),
        ("success_wins_the_race", [*ASKED, *finished(5.0, SUCCEEDED), *canceled(5.2)], "response.status"),
        ("success_wins_the_race", [*LATE_RESULT, *canceled(5.2)], "response.status"),
        (
            "success_wins_the_race",
            [*INTERRUPTED, *finished(5.0, SUCCEEDED), *canceled(5.2)],
            "response.status",
        ),
        (
            "looks_at_the_battery_until_it_sends",
            [*ALONE, *OFFERED, *level(2.0, 0.1), *goal(3.2), *cancel(3.4), *canceled(4.0)],
            "wait_for_server() does not spin",
        ),
        ("takes_standing_and_canceled_in_any_order", [*ASKED, *canceled(3.8)], "wait for the result"),
        ("waits_no_longer_than_5_s", ASKED, "after a cancel, give the wait for the result a timeout"),
        ("waits_no_longer_than_5_s", [*ASKED, *finished(3.6, CANCELED), *canceled(16.0)], "a timeout of 5 s"),
        ("waits_no_longer_than_5_s", [*INTERRUPTED, *ended(17.0, 4, "no end")], "a timeout of 5 s"),
        (
            "waits_for_a_percentage",
            [*NONSENSE, *goal(1.0), *ended(5.7, 1)],
            "A message whose percentage is invalid is not the first one",
        ),
        ("gives_up_in_silence", [*SILENT, *ended(7.8, 1, errors=["silence"])], "before you give up"),
        (
            "tells_a_cancel_by_another",
            [*UNDER_WAY, *finished(3.6, CANCELED), *ended(3.8, 3, errors=["ABORTED"])],
            "response.status",
        ),
        ("a_refused_cancel_is_no_end", [*DROPPED, *cancel(3.1, ()), *ended(3.2, 4, "refused")], "refused"),
    ],
)
def test_each_near_miss_fails_with_its_next_step(check, record, told):
    assert told in failure_of(judge, check, record).help


@pytest.mark.parametrize(
    ("check", "record"),
    [
        ("sends_the_goal", [*UNKNOWN, *goal(2.0)]),
        ("cancels_when_the_battery_drops", [*UNDER_WAY, *cancel(3.1)]),
        ("ignores_what_is_no_percentage", [*ALL_WELL, *ended(5.2, 0, "SUCCEEDED", errors=[WARNED])]),
        ("looks_at_the_battery_until_it_sends", [*READY, *level(3.0, 0.1)]),
        ("waits_until_the_robot_stands", [*UNDER_WAY, *finished(3.7, CANCELED), *canceled(3.9)]),
    ],
)
def test_without_its_stimulus_nothing_passes(check, record):
    with pytest.raises((CannotBeJudged, Failure)):
        judge(check, record)


def test_wrong_arguments_have_to_end_it_before_a_node_is_started():
    usage = ended(0.4, 2, errors=["usage: battery_guard.py"])
    judge("refuses_wrong_arguments", [ev.NodeStarted(t=0.0), *OFFERED, *usage], arguments=["1.5"])
    with pytest.raises(Failure):
        judge("refuses_wrong_arguments", [*READY, *ended(1.0, 2, errors=["usage"])], arguments=["1.5"])
