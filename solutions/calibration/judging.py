"""Compares the answers of the calibration server with the gyro's true bias, and with what the robot published."""

from __future__ import annotations

import re
from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.call import Call, Request
from autograder.authoring.connections import lesson_on_hearing, why_nothing_is_heard
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import shown, shown_fields
from autograder.authoring.missing import unseen
from autograder.authoring.robot_topic import DELIVERY
from autograder.authoring.transcript import Transcript
from ros_runtime.message_constants import RobotMode, name_of

from .bias import TOLERANCE, advice_on_vector, imu_between, is_near, shown_vector, xyz

ASKING = 2.0  # s, at most, for get_status
COLLECTING = 3.0  # s
FEWEST_SAMPLES = 100
AT_ONCE = 0.5  # s for a refusal without looking into anything
EARLY = 0.1  # s less than COLLECTING that pass: clocks are read at either end
LATE = 1.5  # s more than there is work for; the task says 1 s
MOST_SAMPLES = 1000  # a greater number in the message is no count
MOST_NUMBERS = 20  # in the message
LONGEST_COUNT = 12  # characters

_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


# -- what was asked of the grader's get_status ------------------------------------------------------------------------


def run_of(call: Call) -> Transcript:
    """Return the transcript of a call."""
    assert isinstance(call.run, Transcript)
    return call.run


def status_request(call: Call) -> Request | None:
    """Return the request to get_status that belongs to a call: the first one after it was sent."""
    until = call.answer.t if call.answer else call.run.end
    requests = (request for request in run_of(call).requests("get_status"))
    return next((request for request in requests if call.sent.t <= request.received.t <= until), None)


def collecting_from(call: Call) -> float:
    """Return when (s) collecting can begin at the earliest: when get_status answered, or at the request."""
    request = status_request(call)
    return request.reply.t if request and request.reply else call.sent.t


def require_status_asked(call: Call) -> None:
    """Require that get_status was asked, and had answered before the samples were collected."""
    answered = call.answered
    if not call.run.all(ev.ServiceOffered):
        raise unseen(call.run, "nobody offered get_status")
    asked = [request.received.t for request in run_of(call).requests("get_status")]
    expect(
        any(call.sent.t <= t <= answered.t for t in asked),
        expected="a request to get_status while calibrate_imu works",
        observed=f"{len(asked)} requests, all of them at other times" if asked else "none",
        help="Make a client of get_status in the constructor, and in the callback of calibrate_imu ask with "
        "call_async before you collect.",
        at=call.sent.t,
    )


# -- calibrations that succeed ----------------------------------------------------------------------------------------


def require_calibrated(call: Call) -> None:
    """Require success after 3 s of samples, with the gyro's bias and the number of samples in the message."""
    bias = true_bias(call)
    answered = call.answered
    published = imu_between(call, call.sent.t, answered.t)
    call.expect(
        "success",
        True,
        because=f"the robot is {name_of(RobotMode, call.run.robot_at(call.sent.t).mode)} and published imu "
        f"{len(published)} times meanwhile",
        help=_advice_on_failing(call, len(published)),
        see=lesson_on_hearing(call.run, "imu") if not published else "",
    )
    _require_three_seconds(call)
    require_bias_in_message(call, bias)
    require_count_in_message(call, len(imu_between(call, call.sent.t - EARLY, answered.t)))


def true_bias(call: Call) -> Sequence[float]:
    """Return the gyro's bias (rad/s) during a calibration, as the simulator tells it; the robot stood all the while."""
    told = call.run.told("gyro_bias", before=call.sent.t - DELIVERY)
    end = call.answer.t if call.answer else call.run.end
    walking = [
        robot for robot in call.run.robot_between(call.sent.t, end) if robot.mode != RobotMode.STANDING
    ]
    expect(
        not walking,
        expected="the robot standing as long as nobody commands it",
        observed=f"it is {name_of(RobotMode, walking[0].mode) if walking else ''}",
        help="Publish nothing but heartbeat and imu_bias: a calibration commands nothing.",
        at=walking[0].t if walking else None,
    )
    return told.command["bias"]


def _require_three_seconds(call: Call) -> None:
    answered, since = call.answered, collecting_from(call)
    took = answered.t - since
    asked = since > call.sent.t
    after = "after get_status had answered" if asked else "after the request"
    expect(
        took >= COLLECTING - EARLY,
        expected=f"samples of {COLLECTING:g} s, collected {after}",
        observed=f"the answer came {took:.1f} s {after}",
        help="Begin to collect when get_status has answered, not before, and wait 3 s from then."
        if asked and answered.t - call.sent.t >= COLLECTING - EARLY
        else "Wait 3 s between the first sample and the answer: count the time, not the samples.",
        at=answered.t,
    )
    expect(
        took <= COLLECTING + LATE,
        expected=f"an answer within 1 s of the {COLLECTING:g} s of collecting",
        observed=f"it came {took:.1f} s {after}",
        help="Answer when the 3 s are over: wait for time, and not for a number of samples.",
        at=answered.t,
    )


def require_bias_in_message(call: Call, bias: Sequence[float]) -> None:
    """Require the means of x, y and z, in this order, in the message."""
    message = call.response.message
    numbers = [float(number) for number in _NUMBER.findall(message)]
    expect(
        len(numbers) <= MOST_NUMBERS,
        expected=f"a message with the three means and the count, at most {MOST_NUMBERS} numbers in all",
        observed=f"{len(numbers)} numbers",
        help="Say what you have measured, once: whoever reads the message must know which numbers are meant.",
        at=call.answered.t,
    )
    triples = list(zip(numbers, numbers[1:], numbers[2:], strict=False))
    if any(is_near(triple, bias) for triple in triples):
        return
    raise Failure(
        expected=f"a message with the mean angular velocity {shown_vector(bias)} rad/s, within {TOLERANCE:g}",
        observed=f"message: {shown(message)}",
        help=advice_on_vector(call, triples, bias)
        or "Put the three means into the message, x, y and z, as plain numbers in rad/s with at least four decimals.",
        at=call.answered.t,
    )


def require_count_in_message(call: Call, published: int) -> None:
    """Require the number of samples in the message: not more than the robot published meanwhile."""
    message = call.response.message
    integers = whole_numbers(_NUMBER.findall(message))
    counts = [number for number in integers if FEWEST_SAMPLES <= number <= MOST_SAMPLES]
    if any(count <= published for count in counts):
        return
    raise Failure(
        expected=f"the count of samples in the message; the robot published {published} while you worked",
        observed=f"message: {shown(message)}",
        help=f"{counts[0]} samples are more than those of this calibration: begin each one with an empty list."
        if counts
        else "Put the number of samples that you averaged into the message.",
        at=call.answered.t,
    )


def whole_numbers(numbers: Sequence[str]) -> list[int]:
    """Return the whole numbers among these; one of thousands of digits, which Python refuses to read, is no count."""
    short = (number for number in numbers if len(number) <= LONGEST_COUNT)
    return [int(number) for number in short if number.lstrip("+-").isdigit()]


def require_bias_published(call: Call) -> None:
    """Require that imu_bias was published for a calibration, with the gyro's bias in frame imu_link."""
    bias, answered = true_bias(call), call.answered
    published = [
        event for event in run_of(call).heard("imu_bias") if call.sent.t <= event.t <= answered.t + DELIVERY
    ]
    expect(
        bool(published),
        expected="a message on imu_bias within 1 s of the answer",
        observed=_what_is_published(run_of(call)),
        help="Make the publisher of imu_bias in the constructor, and publish one Vector3Stamped before you answer.",
        at=answered.t,
    )
    require_bias_message(call, published[-1], bias)


def require_bias_message(call: Call, event: ev.MessageReceived, bias: Sequence[float]) -> None:
    """Require that a message on imu_bias holds the bias in frame imu_link."""
    header, vector = event.message.header, event.message.vector
    expect(
        header.frame_id == "imu_link",
        expected="header.frame_id 'imu_link': the bias is that of the sensor, about its axes",
        observed=f"header.frame_id {shown(header.frame_id)}",
        help='Set header.frame_id = "imu_link".',
        at=event.t,
    )
    found = (vector.x, vector.y, vector.z)
    expect(
        is_near(found, bias),
        expected=f"imu_bias {shown_vector(bias)} rad/s, within {TOLERANCE:g}",
        observed=shown_vector(found),
        help=advice_on_vector(call, [found], bias)
        or "Publish the mean of the angular velocities of this calibration, in rad/s.",
        at=event.t,
    )


# -- calibrations that are refused, or fail ---------------------------------------------------------------------------


def require_refused(call: Call, *, because: str, within: float = LATE, help: str) -> None:
    """Require success false with a sentence within so many s, and nothing on imu_bias."""
    answered = call.answered
    call.expect("success", False, because=because, help=help)
    expect(
        bool(call.response.message.strip()),
        expected="a message that says why there is no calibration",
        observed="an empty message",
        help="Set response.message to a sentence with the reason.",
        at=answered.t,
    )
    expect(
        call.latency <= within,
        expected=f"a refusal within {within - LATE + 1.0:g} s",
        observed=f"it came {call.latency:.1f} s after the request",
        help="Look at the reasons to refuse before you begin, and return at once.",
        at=answered.t,
    )
    require_nothing_published(call)


def require_refused_meanwhile(first: Call, second: Call) -> None:
    """Require that the second caller was refused while the calibration of the first one ran."""
    if first.answer is not None and second.sent.t >= first.answer.t - DELIVERY:
        require_calibrated(first)  # if it ended early, that is the reason
        raise unseen(first.run, "the second request did not come while the first one was at work")
    require_refused(
        second,
        because="the calibration of another caller was at work",
        help="Remember that a calibration runs from its request to its answer, and refuse others meanwhile.",
    )


def require_nothing_published(call: Call) -> None:
    """Require that imu_bias stayed silent from a request until shortly after its answer."""
    until = call.answered.t + DELIVERY
    published = [event for event in run_of(call).heard("imu_bias") if call.sent.t <= event.t <= until]
    expect(
        not published,
        expected="nothing on imu_bias, as there was no calibration",
        observed=f"{shown_vector(xyz(published[0].message.vector))} was published" if published else "",
        help="Publish on imu_bias only when all is known to be well, just before you answer success: true.",
        at=published[0].t if published else None,
    )


def require_walking_at(call: Call) -> None:
    """Require evidence that the robot walked when the request came, for long enough that the node knew."""
    call.run.told("walk", before=call.sent.t - DELIVERY)
    watched = call.run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    if any(robot.mode != RobotMode.WALKING for robot in watched):
        raise unseen(call.run, "the robot did not walk when calibrate_imu was called")


def require_walk_begun_meanwhile(call: Call) -> None:
    """Require evidence that the robot stood at the request, and walked before the 3 s were over."""
    call.run.told("walk", before=collecting_from(call) + COLLECTING)
    before = call.run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    meanwhile = call.run.robot_between(call.sent.t, collecting_from(call) + COLLECTING - DELIVERY / 2)
    if any(robot.mode == RobotMode.WALKING for robot in before) or not any(
        robot.mode == RobotMode.WALKING for robot in meanwhile
    ):
        raise unseen(call.run, "the robot did not begin to walk during the calibration")


def require_imu_lost(call: Call, *, fewest: int, most: int) -> None:
    """Require evidence that the imu fell silent so that so many samples, more or less, could be collected."""
    call.run.told("imu_sensor", before=collecting_from(call) + COLLECTING, connected=False)
    count = len(imu_between(call, collecting_from(call), collecting_from(call) + COLLECTING))
    if not fewest <= count <= most:
        raise unseen(call.run, f"the robot published imu {count} times, not {fewest} to {most} times")


# -- advice -----------------------------------------------------------------------------------------------------------


def _advice_on_failing(call: Call, published: int) -> str:
    said = shown_fields(call.response, "message")
    if deaf := why_nothing_is_heard(call.run, "imu"):
        return deaf
    if deaf := why_nothing_is_heard(call.run, "robot_state"):
        return deaf
    if call.latency < AT_ONCE:
        return (
            f"You refused at once ({said}), though the robot stood and nothing else was at work: look again at each "
            "request, and forget a calibration when it ends."
        )
    if status_request(call) is None and call.run.all(ev.ServiceOffered):
        return (
            f"The grader's get_status was never asked, and your answer was {said}: did the request get as far as "
            "call_async?"
        )
    waited = call.latency
    if ASKING - EARLY <= waited < COLLECTING:
        return (
            f"get_status had answered, but not to you ({said}): its answer could not be handled while the callback "
            "waited. Give client and service a ReentrantCallbackGroup, or groups of their own and a second thread."
        )
    counts = whole_numbers(re.findall(r"\d+", call.response.message))
    if any(FEWEST_SAMPLES <= count <= published for count in counts):
        return f"{FEWEST_SAMPLES} samples are enough, and you had more ({said}): some messages of a sensor are lost."
    if published >= FEWEST_SAMPLES and waited >= COLLECTING:
        return (
            f"{published} samples came while the callback waited, but they were not counted ({said}): on_imu gets no "
            "turn while the callback holds its thread or its group, or they are dropped where you count."
        )
    return f"Your answer was {said}: refuse only for a reason that the task names."


def _what_is_published(run: Transcript) -> str:
    others = [name for topics in run.all(ev.NodeTopics) for name in topics.publishes]
    names = sorted({name for name in others if not name.endswith(("/rosout", "/parameter_events"))})
    return "none" + (f"; your node publishes {', '.join(names)}" if names else "")
