"""What must hold for every calibration, clause by clause, in every scenario."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from autograder.authoring import (
    DELIVERY,
    Call,
    Failure,
    Obligation,
    Transcript,
    calls,
    expect,
    lesson_on_subscribing,
    obligation,
    require_fastest,
    shown,
    whole_run,
)
from autograder.authoring.requirements.standard_obligations import FROM_MEMORY_TIME
from ros_runtime.message_constants import RobotMode, name_of

from . import heartbeat, truth
from .advice import REASONS, advice_on_failing, advice_on_vector, published_instead
from .message import TOLERANCE, decimals, is_near, numbers_in, shown_vector, triples_in, whole_numbers
from .truth import ASKING, CLOCK_SLACK, COLLECTING, FEWEST_SAMPLES, SERVICE, imu_between, story_of, those

DECIMALS = 4
RATE = 50.0  # Hz, imu
RESPONSE_DELAY = 1.5  # s between the end of the work and the response; the task says 1 s
MAX_NUMBERS = 20  # in a message
MAX_LEAD = 1.2  # s, by which imu_bias may come before the response; the task says 1 s
COUNT_TOLERANCE = 0.1  # as a share of the samples in 3 s, for the best of several counts
SEVERAL = 3  # calibrations, of which the best is checked
SUCCEEDS = (truth.PROMPT, truth.SLOW, truth.SAYS_NO, truth.ENOUGH_SAMPLES)
GETS_NO_ANSWER = (truth.SILENT, truth.ANSWERED_LATE, truth.ANOTHERS_ANSWER, truth.MISSING)
BUSY = (truth.ASKS, truth.COLLECTS)
REFUSED = (truth.UNKNOWN, truth.WALKS, *BUSY)
WALKED = (truth.WALKED_ON, truth.WALKED_SHORTLY)
TOO_FEW = (truth.NO_SAMPLES, truth.FEW_SAMPLES)
CLAUSES = {
    **dict.fromkeys(SUCCEEDS, (1, 2, 3, 4, 14, 15)),
    **dict.fromkeys(GETS_NO_ANSWER, (1, 12, 15, 16)),
    truth.UNKNOWN: (9, 15),
    truth.WALKS: (10, 15),
    **dict.fromkeys(BUSY, (11, 15)),
    **dict.fromkeys(WALKED, (13, 15)),
    **dict.fromkeys(TOO_FEW, (14, 15)),
}

beats = obligation(17, of=whole_run, see="05_executors#groups-why")(heartbeat.beats)


# -- how a request ends -----------------------------------------------------------------------------------------------


def ends_right(*situations: str, after: str = "") -> Obligation:
    """Make the obligation that requests in these situations get the right response, in time and with a reason.

    `after` restricts it to requests after a calibration with that outcome.
    """

    def ends(call: Call) -> str:
        story = story_of(call)
        assert story
        (_require_success if story.end == "succeeds" else _require_no_success)(call, story)
        return _situation(call)

    ends.__name__ = "ends_right"
    ends.__doc__ = f"The response is right: {'; '.join(situations)}" + (f" (after {after})" if after else "")
    clauses = sorted({clause for each in situations for clause in CLAUSES[each]})
    return obligation(*clauses, of=those(*situations, after=after))(ends)


def _require_success(call: Call, story: truth.Story) -> None:
    run = call.run
    published = len(imu_between(run, call.sent.t, call.answered.t))
    call.expect(
        "success",
        True,
        because=f"the robot is {name_of(RobotMode, run.robot_at(call.sent.t).mode)}, get_status responded, and "
        f"{published} imu messages came",
        help=advice_on_failing(call, story, published),
        see="" if published else lesson_on_subscribing(run, "imu"),
    )
    took = call.answered.t - story.since
    call.require(
        COLLECTING - CLOCK_SLACK <= took <= COLLECTING + RESPONSE_DELAY,
        expected=f"the response {COLLECTING:g} to {COLLECTING + 1:g} s after that of get_status: {COLLECTING:g} s of "
        "samples, and at most 1 s more",
        observed=f"the response came {took:.1f} s after that of get_status",
        help="Send the response when the 3 s are over: wait for the time, not for a number of samples."
        if took > COLLECTING
        else "Start to collect samples when get_status has responded, not earlier, and wait 3 s from then.",
    )


def _require_no_success(call: Call, story: truth.Story) -> None:
    because, help = REASONS[story.situation]
    call.expect("success", False, because=because, help=help)
    text, unanswered = call.response.message, story.situation in GETS_NO_ANSWER
    never_asked = unanswered and story.situation != truth.MISSING and not truth.status_requests(call)
    call.require(
        "get_status" in text if unanswered else bool(text.strip()),
        expected=f"a message that says why there is no calibration: {because}",
        observed=f"message: {shown(text)}",
        help="Your server did not call get_status: in a finally block record that the calibration has ended, and call "
        "get_status in each calibration."
        if never_asked
        else "Set response.message to a sentence with the reason; if the reason is get_status, name it.",
    )
    refused = story.end == "is rejected"
    due = 0.0 if refused else ASKING if math.isnan(story.since) else story.since - call.sent.t + COLLECTING
    call.require(
        call.latency <= due + RESPONSE_DELAY,
        expected=f"success: false within {due + 1.0:.1f} s",
        observed=f"the response came {call.latency:.1f} s after the request",
        help=f"{help} Check that first, and return at once."
        if refused
        else "Send the response as soon as it is certain that the calibration fails.",
    )
    _require_silence(call)


@obligation(1, of=those(*SUCCEEDS, *TOO_FEW), see="05_executors#report-why")
def asks_get_status(call: Call) -> str | None:
    """It calls get_status from inside its callback"""
    story = story_of(call)
    asked = call.run.requests("get_status")
    call.require(
        bool(truth.status_requests(call)),
        expected="a request to get_status during the request to calibrate_imu",
        observed=f"{len(asked)} requests, all at other times" if asked else "no request",
        help="Create a client of get_status in the constructor, and use call_async before you collect samples.",
    )
    return story.situation if story else None


@obligation(3, 11, of=whole_run)
def calibrates_one_at_a_time(run: Transcript) -> str | None:
    """Only one calibration runs at a time, so two successes are at least 3 s apart"""
    ends = sorted(call.answered.t for call in calls(SERVICE)(run) if call.response.success)
    for before, after in pairwise(ends):
        expect(
            after - before >= COLLECTING - CLOCK_SLACK,
            expected=f"at least {COLLECTING:g} s between two successes, as only one calibration runs at a time",
            observed=f"two calibrations succeeded {after - before:.1f} s apart",
            help="At the start of the callback, before any await, check whether a calibration is running and record "
            "that one is.",
            at=after,
        )
    return "several" if len(ends) > 1 else None


@obligation(9, 10, 11, 12, of=whole_run)
def wastes_no_time(run: Transcript) -> str | None:
    """It rejects requests at once, and waits at most 2 s for get_status"""
    judged = []
    for situations, limit, help in (
        (REFUSED, 0.0, "Check the reasons to reject a request first, and return at once."),
        (GETS_NO_ANSWER, ASKING, "Wait 2 s in total for get_status and its server, then send the response."),
    ):
        each = those(*situations)(run)
        if len(each) < SEVERAL:
            continue
        expected = f"success: false after {limit:g} s" if limit else "success: false at once"
        require_fastest(each, limit + FROM_MEMORY_TIME, expected=expected, help=help)
        judged.append(f"{len(each)} times")
    return ", ".join(judged) or None


# -- the measured bias ------------------------------------------------------------------------------------------------


@obligation(5, 6, 8, of=those(*SUCCEEDS), see="05_executors#await-why")
def tells_the_means(call: Call) -> str | None:
    """The message has the means of x, y and z with at least four decimals"""
    if not call.response.success:
        return None
    message, means = call.response.message, _means(call)
    numbers = numbers_in(message)
    call.require(
        len(numbers) <= MAX_NUMBERS,
        expected=f"a message with the three means and the number of samples, at most {MAX_NUMBERS} numbers in total",
        observed=f"{len(numbers)} numbers",
        help="Write each result once, so that a reader knows which numbers are meant.",
    )
    triples = triples_in(numbers)
    right = [triple for triple in triples if is_near(triple, means)]
    call.require(
        bool(right),
        expected=f"a message with the mean angular velocity {shown_vector(means)} rad/s, within {TOLERANCE:g}",
        observed=f"message: {shown(message)}",
        help=advice_on_vector(call, [[float(one) for one in triple] for triple in triples], means)
        or "Write the means of x, y and z into the message, as numbers in rad/s with at least four decimals.",
    )
    call.require(
        any(max(map(decimals, triple)) >= DECIMALS for triple in right),
        expected=f"the means with at least {DECIMALS} decimals",
        observed=f"message: {shown(message)}",
        help="Write more decimals, for example f'{x:.5f}': a bias of some thousandths needs at least four.",
    )
    return _situation(call)


@obligation(5, 8, of=those(*SUCCEEDS))
def tells_the_count(call: Call) -> str | None:
    """The message has the number of samples in this calibration"""
    if not call.response.success:
        return None
    story, run = story_of(call), call.run
    assert story
    came = len(imu_between(run, story.since - DELIVERY / 2, call.answered.t))
    counts = whole_numbers(call.response.message)
    more = [count for count in counts if count > came]
    call.require(
        any(FEWEST_SAMPLES <= count <= came for count in counts),
        expected=f"the number of samples in the message, from {FEWEST_SAMPLES} to {came}, as {came} messages came",
        observed=f"message: {shown(call.response.message)}",
        help=f"In this calibration fewer than {more[0]} samples came: start each calibration with an empty list."
        if more
        else "Write the number of averaged samples into the message.",
    )
    return _situation(call)


@obligation(3, 5, of=whole_run)
def collects_for_three_seconds(run: Transcript) -> str | None:
    """The number of samples in the message matches 3 s"""
    whole = [call for call in those(truth.PROMPT, truth.SLOW, truth.SAYS_NO)(run) if call.response.success]
    said = [count for call in whole for count in whole_numbers(call.response.message)]
    counts = [count for count in said if FEWEST_SAMPLES <= count <= 2 * RATE * COLLECTING]
    if len(whole) < SEVERAL or not counts:
        return None
    due = RATE * COLLECTING
    nearest = min(counts, key=lambda count: abs(count - due))
    whole[-1].require(
        abs(nearest - due) <= COUNT_TOLERANCE * due,
        expected=f"about {due:g} samples, as many as come in {COLLECTING:g} s",
        observed=f"{nearest} samples, the nearest number in {len(whole)} calibrations",
        help="Average exactly the samples that come during the 3 s, and write their number into the message.",
    )
    return "several"


@obligation(6, of=those(*SUCCEEDS), see="01_robot_and_graph#conventions")
def publishes_the_means(call: Call) -> str | None:
    """With each success, one message is published on imu_bias, with the same means, in frame imu_link"""
    if not call.response.success:
        return None
    answered, run, means = call.answered, call.run, _means(call)
    earliest, latest = answered.t - MAX_LEAD, answered.t + DELIVERY
    published = [event for event in run.received("imu_bias") if earliest <= event.t <= latest]
    call.require(
        len(published) == 1,
        expected="one message on imu_bias for each success, within 1 s before the response",
        observed=f"{len(published)} messages" if published else published_instead(run),
        help="Publish once, just before you return success true."
        if published
        else "Create the publisher of imu_bias in the constructor, and publish one Vector3Stamped before you return "
        "the response.",
    )
    _require_bias(call, published[0].message, means)
    return _situation(call)


@obligation(7, of=whole_run, see="01_robot_and_graph#late-why")
def latches_the_bias(run: Transcript) -> str | None:
    """imu_bias is latched: a node that subscribes later receives the last message"""
    done = [call for call in those(*SUCCEEDS)(run) if call.response.success]
    if not done:
        return None
    heard = run.received("imu_bias")
    done[-1].require(
        bool(heard),
        expected="a node that subscribes after the calibration to receive the last imu_bias",
        observed="it received no message",
        help="Give the publisher durability TRANSIENT_LOCAL: it keeps the last message for later subscriptions.",
    )
    _require_bias(done[-1], heard[-1].message, _means(done[-1]))
    return "subscribed later"


def _require_bias(call: Call, message: object, means: Sequence[float]) -> None:
    header, vector = message.header, message.vector  # type: ignore[attr-defined]
    found = (vector.x, vector.y, vector.z)
    call.require(
        is_near(found, means),
        expected=f"imu_bias {shown_vector(means)} rad/s, within {TOLERANCE:g}",
        observed=shown_vector(found),
        help=advice_on_vector(call, [found], means)
        or "Publish the mean of the angular velocities of this calibration, in rad/s.",
    )
    triples = triples_in(numbers_in(call.response.message))
    told = [triple for triple in triples if is_near(triple, means)]
    call.require(
        not told or any(is_near(found, triple, _rounding(triple)) for triple in told),
        expected="the same means in the response's message and on imu_bias, except for rounding",
        observed=f"imu_bias {shown_vector(found)}, message: {shown(call.response.message)}",
        help="Compute the means once, and round them only in the message, to four decimals or more.",
    )
    call.require(
        header.frame_id == "imu_link",
        expected="header.frame_id 'imu_link', as the bias is about the sensor's axes",
        observed=f"header.frame_id {shown(header.frame_id)}",
        help='Set header.frame_id = "imu_link" before you publish.',
        see="01_robot_and_graph#frames-why",
    )


def _require_silence(call: Call) -> None:
    """Require no message on imu_bias from a request until shortly after its response, except for others' successes."""
    run = call.run
    others = [other.answer for other in calls(SERVICE)(run) if other.name != call.name and other.answer]
    successes = [answer.t for answer in others if answer.response.success]
    for event in run.received("imu_bias"):
        excused = any(end - MAX_LEAD <= event.t <= end + DELIVERY for end in successes)
        if call.sent.t <= event.t <= call.answered.t + DELIVERY and not excused:
            vector = event.message.vector
            raise Failure(
                expected="no message on imu_bias, as the calibration did not succeed",
                observed=f"{shown_vector((vector.x, vector.y, vector.z))} was published",
                help="Publish on imu_bias only just before you return success true.",
                at=event.t,
            )


def _means(call: Call) -> tuple[float, ...]:
    """Return the means (rad/s) of the samples that the robot published during a calibration."""
    story = story_of(call)
    assert story
    samples = [each.angular_velocity for each in imu_between(call.run, story.since, call.answered.t)]
    return tuple(sum(each[axis] for each in samples) / max(1, len(samples)) for axis in range(3))


def _rounding(triple: Sequence[str]) -> float:
    """Return the largest possible rounding error (rad/s) of numbers with so many decimals."""
    return max(1e-6, 1.1 * 10.0 ** -max(0, *map(decimals, triple)))


def _situation(call: Call) -> str:
    story = story_of(call)
    return f"{story.situation}, after {story.after or 'nothing'}" if story else ""
