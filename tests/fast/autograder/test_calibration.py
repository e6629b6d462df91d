"""What a calibration that goes wrong is told: where the thread was held, and what kind of mean it has computed."""

from __future__ import annotations

from typing import Any

import pytest
from records import answered, asked, failure_of, run_of
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

from autograder.authoring import events as ev
from autograder.authoring.transcript import Transcript
from autograder.engine.exercise import exercise_module

JUDGING = exercise_module("calibration", "judging")
HEARTBEAT = exercise_module("calibration", "heartbeat")
BEFORE, BIAS = (-0.012, 0.008, -0.005), (0.010, -0.008, 0.012)  # rad/s
SENT, ANSWERED, END = 8.0, 12.0, 14.0  # s


def calibration(message: str, *others: ev.Event) -> Transcript:
    told = [
        ev.RobotCommanded(t=t, command={"do": "gyro_bias", "bias": list(bias)})
        for t, bias in ((2.0, BEFORE), (6.0, BIAS))
    ]
    reply = Trigger.Response(success=True, message=message)
    call = [asked("second", "calibrate_imu", t=SENT), answered("second", t=ANSWERED, response=reply)]
    return run_of(*told, *call, *others, until=END)


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
    ("message", "next_step"),
    [
        (f"bias {mean(0.5)}, 300 samples", "Samples of before are in it"),
        (f"bias {mean(0.0)}, 150 samples", "Samples of before are in it"),
        ("bias 0.01 0.02 9.81, 150 samples", "These are accelerations"),
        ("bias 1.5 -1.2 1.8, 150 samples", ""),
        ("bias 0.573 -0.458 0.688, 150 samples", "These are degrees"),
        ("bias -0.010 0.008 -0.012, 150 samples", "The signs are the wrong way round"),
    ],
)
def test_a_wrong_bias_is_told_what_kind_of_mean_it_is(message: str, next_step: str) -> None:
    call = calibration(message).call("second")
    assert next_step in failure_of(JUDGING.require_bias_in_message, call, BIAS).help


def test_a_list_of_guesses_is_no_bias() -> None:
    guesses = "; ".join(mean(number / 20) for number in range(21))
    failure = failure_of(JUDGING.require_bias_in_message, calibration(guesses).call("second"), BIAS)
    assert failure.observed == "63 numbers"


@pytest.mark.parametrize(
    ("silence", "next_step"),
    [
        ((SENT + 0.5, ANSWERED - 0.5), "The timer gets no turn while the callback of calibrate_imu waits"),
        ((3.0, 6.0), "The timer of the heartbeat must go on as long as the node runs"),
    ],
)
def test_a_gap_is_explained_by_the_request_that_was_at_work(
    silence: tuple[float, float], next_step: str
) -> None:
    first = [asked("first", "calibrate_imu", t=1.5), answered("first", t=2.0)]
    run = calibration("", *first, *beats(silence))
    failure = failure_of(HEARTBEAT.require_heartbeat, run, run.call("first"), "while it was at work")
    assert next_step in failure.help


def test_a_number_of_thousands_of_digits_is_no_count() -> None:
    call = calibration("mean 0.010 -0.008 0.012 of " + "9" * 5000).call("second")
    assert "Put the number of samples" in failure_of(JUDGING.require_count_in_message, call, 300).help


def test_whole_numbers_are_those_that_can_be_a_count() -> None:
    assert JUDGING.whole_numbers(["150", "-2", "0.5", "9" * 5000]) == [150, -2]
