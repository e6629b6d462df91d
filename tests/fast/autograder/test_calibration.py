"""The required outcome of a calibration, and the failures of a wrong one."""

from __future__ import annotations

from typing import Any

import pytest
from geometry_msgs.msg import Vector3, Vector3Stamped
from std_msgs.msg import Empty, Header
from std_srvs.srv import Trigger

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.msg import RobotState
from records import answered, asked, failure_of, robot, run_of

MODEL = exercise_module("calibration", "model")
TRUTH = exercise_module("calibration", "truth")
MESSAGE = exercise_module("calibration", "message")
BEFORE, BIAS = (-0.012, 0.008, -0.005), (0.010, -0.008, 0.012)  # rad/s
SENT, REPLIED, ANSWERED, END = 8.0, 8.02, 11.1, 14.0  # s
GOOD = "bias 0.01000 -0.00800 0.01200 of 150 samples"


def calibration(
    message: str = GOOD,
    *others: ev.Event,
    success: bool = True,
    reply: float | None = REPLIED,
    walks: tuple[float, float] = (END, END),
    imu_until: float = END,
) -> Transcript:
    """One calibration; get_status answers at `reply` (s; None: never), and the robot walks in between."""
    prints = [
        ev.RobotCommanded(t=t, command={"do": "gyro_bias", "bias": list(bias)})
        for t, bias in ((2.0, BEFORE), (6.0, BIAS))
    ]
    times = [0.02 * number for number in range(int(END / 0.02))]
    imu = [
        ev.ImuPublished(t=t, angular_velocity=list(BIAS), gyro_bias=list(BIAS))
        for t in times
        if t < imu_until
    ]
    body = [
        robot(t, mode=RobotState.WALKING if walks[0] <= t < walks[1] else RobotState.STANDING) for t in times
    ]
    status: list[Any] = [
        ev.ServiceOffered(t=0.5, service="get_status", server="server 1", type="std_srvs/srv/Trigger"),
        ev.RequestReceived(
            t=SENT + 0.01,
            request="request 1",
            service="get_status",
            server="server 1",
            message=Trigger.Request(),
        ),
    ]
    if reply is not None:
        status.append(
            ev.ReplySent(t=reply, request="request 1", response=Trigger.Response(success=True, message="ON"))
        )
    response = Trigger.Response(success=success, message=message)
    call = [
        asked("only", TRUTH.SERVICE, t=SENT),
        answered("only", t=ANSWERED, response=response),
    ]
    return run_of(*prints, *imu, *body, *status, *call, *others, until=END)


def published(*vector: float, frame: str = "imu_link", t: float = ANSWERED) -> ev.Event:
    x, y, z = vector
    message = Vector3Stamped(header=Header(frame_id=frame), vector=Vector3(x=x, y=y, z=z))
    return ev.MessageReceived(t=t, topic="imu_bias", message=message)


def beats(*silences: tuple[float, float]) -> list[Any]:
    times = [0.1 * number for number in range(10, int(END * 10))]
    return [
        ev.MessageReceived(t=t, topic="heartbeat", message=Empty())
        for t in times
        if not any(start < t < end for start, end in silences)
    ]


def mean(share: float) -> str:
    return " ".join(f"{share * new + (1 - share) * old:.5f}" for new, old in zip(BIAS, BEFORE, strict=True))


@pytest.mark.parametrize(
    ("meanwhile", "end", "situation"),
    [
        ({}, "succeeds", TRUTH.PROMPT),
        ({"reply": SENT + 1.2}, "succeeds", TRUTH.SLOW),
        ({"reply": None}, "fails", TRUTH.SILENT),
        ({"reply": SENT + 2.9}, "fails", TRUTH.ANSWERED_LATE),
        ({"walks": (SENT - 3, SENT + 3)}, "is rejected", TRUTH.WALKS),
        ({"walks": (SENT + 0.3, SENT + 1.5)}, "fails", TRUTH.WALKED_SHORTLY),
        ({"walks": (SENT + 1.0, END)}, "fails", TRUTH.WALKED_ON),
        ({"imu_until": SENT - 2}, "fails", TRUTH.NO_SAMPLES),
        ({"imu_until": SENT + 1.2}, "fails", TRUTH.FEW_SAMPLES),
        ({"imu_until": SENT + 2.5}, "succeeds", TRUTH.ENOUGH_SAMPLES),
    ],
)
def test_what_happens_meanwhile_decides_how_a_calibration_ends(
    meanwhile: Any, end: str, situation: str
) -> None:
    story = TRUTH.story_of(calibration(**meanwhile).call("only"))
    assert (story.end, story.situation) == (end, situation)


@pytest.mark.parametrize(
    "meanwhile",
    [{"reply": SENT + 1.9}, {"walks": (SENT - 0.5, END)}, {"imu_until": SENT + 2.0}],
)
def test_for_a_message_in_transit_either_outcome_is_right(meanwhile: Any) -> None:
    assert TRUTH.story_of(calibration(**meanwhile).call("only")) is None


@pytest.mark.parametrize(
    ("message", "next_step"),
    [
        (f"bias {mean(0.5)}, 300 samples", "This mean includes earlier samples"),
        (f"bias {mean(0.0)}, 150 samples", "This mean includes earlier samples"),
        ("bias 0.01 0.02 9.81, 150 samples", "These are accelerations"),
        ("bias 1.55 -1.24 1.86, 155 samples", "These are the sums"),
        ("bias 0.573 -0.458 0.688, 150 samples", "These are degrees"),
        ("bias -0.010 0.008 -0.012, 150 samples", "The signs are inverted"),
        ("bias 0.010 -0.008 0.012, 150 samples", "Write more decimals"),
    ],
)
def test_a_wrong_bias_is_explained_by_the_kind_of_mean_it_is(message: str, next_step: str) -> None:
    assert next_step in failure_of(MODEL.tells_the_means.judge, calibration(message)).help


@pytest.mark.parametrize(
    "message",
    [
        GOOD,
        "x: 1.0001e-02, y: -7.999e-3, z: 1.2000e-02 rad/s; n=151",
        "axis 1: 0.0100, axis 2: -0.0080, axis 3: 0.0120; 149 samples in 3.0 s",
    ],
)
def test_the_means_may_be_written_in_many_ways(message: str) -> None:
    run = calibration(message)
    assert MODEL.tells_the_means.judge(run)
    assert MODEL.tells_the_count.judge(run)


def test_a_list_of_guesses_is_not_accepted_as_the_bias() -> None:
    guesses = "; ".join(mean(number / 20) for number in range(21))
    assert failure_of(MODEL.tells_the_means.judge, calibration(guesses)).observed == "63 numbers"


@pytest.mark.parametrize(
    ("messages", "next_step"),
    [
        ([published(*BIAS, frame="")], "Set header.frame_id"),
        ([published(*BEFORE)], "This mean includes earlier samples"),
        ([published(0.0104, -0.008, 0.012)], "Compute the means once"),
        ([published(*BIAS), published(*BIAS)], "Publish once"),
        ([], "Create the publisher of imu_bias"),
    ],
)
def test_each_success_publishes_its_means_once(messages: list[ev.Event], next_step: str) -> None:
    assert next_step in failure_of(MODEL.publishes_the_means.judge, calibration(GOOD, *messages)).help


def test_a_calibration_that_fails_publishes_nothing() -> None:
    run = calibration("the robot walked", published(*BIAS), success=False, walks=(SENT + 1.0, END))
    failure = failure_of(MODEL.ends_right(TRUTH.WALKED_ON).judge, run)
    assert failure.expected.startswith("no message on imu_bias")


@pytest.mark.parametrize(
    ("silence", "next_step"),
    [
        (
            (SENT + 0.5, ANSWERED - 0.5),
            "The timer's callback cannot run while the callback of calibrate_imu blocks",
        ),
        ((3.0, 6.0), "The heartbeat's timer must run as long as the node"),
    ],
)
def test_a_gap_is_explained_by_the_request_that_was_being_processed(
    silence: tuple[float, float], next_step: str
) -> None:
    assert next_step in failure_of(MODEL.beats.judge, calibration(GOOD, *beats(silence))).help


def test_a_gap_without_a_blocked_callback_is_explained_by_the_group() -> None:
    stack = ev.NodeStack(
        t=END, lines=["Current thread (most recent call first):", '  File "executors.py", line 9 in spin']
    )
    run = calibration(GOOD, stack, *beats((SENT + 0.5, ANSWERED - 0.5)))
    assert "ReentrantCallbackGroup" in failure_of(MODEL.beats.judge, run).help


def test_a_number_of_thousands_of_digits_is_not_read_as_a_count() -> None:
    run = calibration("mean 0.010 -0.008 0.012 of " + "9" * 5000)
    assert "Write the number of averaged samples" in failure_of(MODEL.tells_the_count.judge, run).help


def test_numbers_are_read_as_they_are_written() -> None:
    assert MESSAGE.whole_numbers("150, -2, 0.5 and " + "9" * 5000) == [150, -2]
    assert [MESSAGE.decimals(number) for number in ("0.0123", "1.23e-02", "150", "1e" + "9" * 5000)] == [
        4,
        4,
        0,
        0,
    ]
