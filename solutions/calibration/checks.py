"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring import standard
from autograder.authoring.checks import MAY_REST, RESTING, Scenario, check, expect
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

from .heartbeat import require_heartbeat
from .judging import (
    ASKING,
    COLLECTING,
    LATE,
    require_bias_message,
    require_bias_published,
    require_calibrated,
    require_imu_lost,
    require_refused,
    require_refused_meanwhile,
    require_status_asked,
    require_walk_begun_meanwhile,
    require_walking_at,
    true_bias,
)

BIASES = [[0.012, -0.008, 0.005], [-0.006, 0.011, -0.009]]  # rad/s
AHEAD = [0.3, 0.0, 0.0]  # m/s, m/s, rad/s

INTERRUPT = Scenario("interrupt", robot=RESTING)
TWICE = Scenario("calibrate_twice", {"biases": BIASES}, robot=RESTING)
LATE_LISTENER = Scenario("calibrate_and_listen_late", {"bias": BIASES[0]}, robot=RESTING)
WALKS = Scenario("calibrate_while_walking", {"velocity": AHEAD})
WALK_BEGINS = Scenario("begin_to_walk_meanwhile", {"begin": 0.8, "velocity": AHEAD, "steps": 0})
SILENT_ROBOT = Scenario("calibrate_before_the_first_state", robot=(MAY_REST, "--robot-state-unpublished"))
TWO_CALLERS = Scenario("calibrate_from_two_clients", {"apart": 1.0, "status_after": 0.0}, robot=RESTING)
SILENT_STATUS = Scenario("calibrate_without_an_answer", robot=RESTING)
NO_IMU = Scenario("lose_the_imu", {"begin": 0.0}, robot=RESTING)

WAITS = "05_executors#await-why"
GROUPS = "05_executors#groups-why"
ASKS = "05_executors#report-why"
REFUSES = "02_services#set-refuse-why"
KNOWS_NOTHING = "02_services#m9-fix-why"
PUBLISHES = "01_robot_and_graph#late-why"

server_appears = standard.server_appears("calibrate_imu", points=1, on=INTERRUPT)


@check(points=2, on=TWICE, needs=server_appears, see=GROUPS)
def keeps_its_heartbeat(run: Transcript) -> None:
    """The heartbeat goes on at 10 Hz while it calibrates"""
    require_heartbeat(run, run.call("first"), "while calibrate_imu was at work")


@check(points=1, on=SILENT_ROBOT, needs=server_appears, see=KNOWS_NOTHING)
def refuses_before_the_first_state(run: Transcript) -> None:
    """As long as no robot_state has come, it refuses"""
    call = run.call("before the first state")
    if any(
        command.t <= call.answered.t
        for command in run.all(ev.RobotCommanded)
        if "published" in command.command
    ):
        raise unseen(run, "robot_state was published too early")
    require_refused(
        call,
        because="no robot_state had come, so nobody knows whether the robot stands",
        help="Begin with no state (None), and refuse as long as it is None.",
    )


@check(points=2, on=WALKS, needs=server_appears, see=REFUSES)
def refuses_while_walking(run: Transcript) -> None:
    """While the robot walks, it refuses"""
    call = run.call("while it walks")
    require_walking_at(call)
    require_refused(
        call,
        because="the robot was WALKING when calibrate_imu was called",
        help="Keep the last robot_state, and refuse at once while its mode is RobotState.WALKING.",
    )


@check(points=1, on=TWICE, needs=server_appears, see=ASKS)
def asks_get_status(run: Transcript) -> None:
    """It asks get_status from inside its callback"""
    require_status_asked(run.call("first"))


@check(points=3, on=TWICE, needs=asks_get_status, see=WAITS)
def calibrates(run: Transcript) -> None:
    """When the robot stands, it answers after 3 s with the gyro's bias and the count of samples"""
    require_calibrated(run.call("first"))


@check(points=2, on=SILENT_STATUS, needs=asks_get_status, see=ASKS)
def refuses_without_an_answer(run: Transcript) -> None:
    """When get_status gives no answer in 2 s, it refuses and says so"""
    call = run.call("silent status")
    require_status_asked(call)
    require_refused(
        call,
        because="get_status gave no answer",
        within=ASKING + LATE,
        help="Set a limit of 2 s to the wait for get_status, and refuse when there is no answer by then.",
    )
    expect(
        "get_status" in call.response.message,
        expected="a message that names get_status, which gave no answer",
        observed=f"message: {call.response.message!r}",
        help="Say in the message what was missing: that get_status gave no answer.",
        at=call.answered.t,
    )


@check(points=2, on=SILENT_STATUS, needs=[asks_get_status, keeps_its_heartbeat], see=GROUPS)
def lives_while_it_waits(run: Transcript) -> None:
    """The heartbeat goes on while get_status is silent"""
    require_heartbeat(run, run.call("silent status"), "while get_status was silent")


@check(points=2, on=TWO_CALLERS, needs=calibrates, see=GROUPS)
def refuses_a_second_caller(run: Transcript) -> None:
    """While a calibration runs, a second caller is refused at once, and the first one gets its answer"""
    first, second = run.call("first caller"), run.call("second caller")
    require_refused_meanwhile(first, second)
    require_calibrated(first)


@check(points=2, on=WALK_BEGINS, needs=calibrates, see="05_executors#why")
def fails_when_it_begins_to_walk(run: Transcript) -> None:
    """When the robot begins to walk meanwhile, the calibration fails"""
    call = run.call("it begins to walk")
    require_walk_begun_meanwhile(call)
    require_refused(
        call,
        because="the robot began to walk while the samples were collected",
        within=COLLECTING + LATE,
        help="Look at robot_state until the 3 s are over, not only at the request.",
    )


@check(points=1, on=NO_IMU, needs=calibrates, see=KNOWS_NOTHING)
def fails_without_samples(run: Transcript) -> None:
    """When the imu is silent, the calibration fails and the node lives on"""
    call = run.call("the imu falls silent")
    require_imu_lost(call, fewest=0, most=0)
    require_refused(
        call,
        because="the imu was silent",
        within=COLLECTING + LATE,
        help="Compare the number of samples with 100 before you divide by it.",
    )


@check(points=1, on=TWICE, needs=calibrates, see=PUBLISHES)
def publishes_the_bias(run: Transcript) -> None:
    """It publishes the bias on imu_bias, in frame imu_link"""
    require_bias_published(run.call("first"))


@check(points=1, on=LATE_LISTENER, needs=publishes_the_bias, see=PUBLISHES)
def latches_the_bias(run: Transcript) -> None:
    """imu_bias is latched: a node that subscribes later gets the last one"""
    call = run.call("before anybody listens")
    require_calibrated(call)
    heard = run.heard("imu_bias")
    expect(
        bool(heard),
        expected="the last imu_bias, sent to a node that subscribes after the calibration",
        observed="none",
        help="Give the publisher durability TRANSIENT_LOCAL: it keeps the last message for those who come later.",
        at=call.answered.t,
    )
    require_bias_message(call, heard[-1], true_bias(call))


ends_cleanly = standard.ends_cleanly(points=1, on=INTERRUPT, needs=server_appears)
