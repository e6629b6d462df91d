"""What must hold of every calibration, clause by clause, in every scenario."""

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
LATER = 1.5  # s more than there is work for; the task says 1 s
MOST_NUMBERS = 20  # in a message
LATEST_BEFORE = 1.2  # s before its answer: the 1 s that the answer may take, and some
SHARE = 0.1  # of the samples of 3 s, by which the best of several counts may differ
SEVERAL = 3  # calibrations, of which the best is looked at
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
    """Make the obligation that requests in these situations end as they must, in time and with a reason.

    `after`: only requests that come after a calibration that ended so.
    """

    def ends(call: Call) -> str:
        story = story_of(call)
        assert story
        (_require_success if story.end == "succeeds" else _require_no_success)(call, story)
        return _situation(call)

    ends.__name__ = "ends_right"
    ends.__doc__ = f"It ends as it must: {'; '.join(situations)}" + (f" (after {after})" if after else "")
    clauses = sorted({clause for each in situations for clause in CLAUSES[each]})
    return obligation(*clauses, of=those(*situations, after=after))(ends)


def _require_success(call: Call, story: truth.Story) -> None:
    run = call.run
    published = len(imu_between(run, call.sent.t, call.answered.t))
    call.expect(
        "success",
        True,
        because=f"the robot is {name_of(RobotMode, run.robot_at(call.sent.t).mode)}, get_status answered and imu came "
        f"{published} times meanwhile",
        help=advice_on_failing(call, story, published),
        see="" if published else lesson_on_subscribing(run, "imu"),
    )
    took = call.answered.t - story.since
    call.require(
        COLLECTING - CLOCK_SLACK <= took <= COLLECTING + LATER,
        expected=f"{COLLECTING:g} s of samples, collected after get_status had answered, and the answer within 1 s",
        observed=f"the answer came {took:.1f} s after that of get_status",
        help="Answer when the 3 s are over: wait for time, and not for a number of samples."
        if took > COLLECTING
        else "Begin to collect when get_status has answered, not before, and wait 3 s from then.",
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
        help="get_status was not even asked: forget a calibration however it ends, and ask afresh in the next one."
        if never_asked
        else "Set response.message to a sentence with the reason; if get_status is the reason, name it.",
    )
    refused = story.end == "is refused"
    due = 0.0 if refused else ASKING if math.isnan(story.since) else story.since - call.sent.t + COLLECTING
    call.require(
        call.latency <= due + LATER,
        expected=f"success: false within {due + 1.0:.1f} s",
        observed=f"it came {call.latency:.1f} s after the request",
        help=f"{help} Look at that before you begin, and return at once."
        if refused
        else "Answer as soon as it is certain that there will be no calibration.",
    )
    _require_silence(call)


@obligation(1, of=those(*SUCCEEDS, *TOO_FEW), see="05_executors#report-why")
def asks_get_status(call: Call) -> str | None:
    """It asks get_status from inside its callback"""
    story = story_of(call)
    asked = call.run.requests("get_status")
    call.require(
        bool(truth.status_requests(call)),
        expected="a request to get_status while calibrate_imu works",
        observed=f"{len(asked)} requests, all of them at other times" if asked else "none",
        help="Make a client of get_status in the constructor, and ask with call_async before you collect.",
    )
    return story.situation if story else None


@obligation(3, 11, of=whole_run)
def calibrates_one_at_a_time(run: Transcript) -> str | None:
    """One calibration runs at a time, so two successes are 3 s apart"""
    ends = sorted(call.answered.t for call in calls(SERVICE)(run) if call.response.success)
    for before, after in pairwise(ends):
        expect(
            after - before >= COLLECTING - CLOCK_SLACK,
            expected=f"{COLLECTING:g} s from the end of one calibration to that of the next: one runs at a time",
            observed=f"two succeeded {after - before:.1f} s apart",
            help="Look whether a calibration runs, and note that one does, before anything else, and before any await.",
            at=after,
        )
    return "several" if len(ends) > 1 else None


@obligation(9, 10, 11, 12, of=whole_run)
def wastes_no_time(run: Transcript) -> str | None:
    """It refuses at once, and does not wait for get_status longer than 2 s"""
    judged = []
    for situations, limit, help in (
        (REFUSED, 0.0, "Look at the reasons to refuse before anything else, and return at once."),
        (GETS_NO_ANSWER, ASKING, "Wait for get_status 2 s in all, also for its server, and answer then."),
    ):
        each = those(*situations)(run)
        if len(each) < SEVERAL:
            continue
        expected = f"success: false after {limit:g} s" if limit else "refusals at once"
        require_fastest(each, limit + FROM_MEMORY_TIME, expected=expected, help=help)
        judged.append(f"{len(each)} times")
    return ", ".join(judged) or None


# -- what it has measured ---------------------------------------------------------------------------------------------


@obligation(5, 6, 8, of=those(*SUCCEEDS), see="05_executors#await-why")
def tells_the_means(call: Call) -> str | None:
    """The message holds the means of x, y and z, with four decimals at least"""
    if not call.response.success:
        return None
    message, means = call.response.message, _means(call)
    numbers = numbers_in(message)
    call.require(
        len(numbers) <= MOST_NUMBERS,
        expected=f"a message with the three means and the count, at most {MOST_NUMBERS} numbers in all",
        observed=f"{len(numbers)} numbers",
        help="Say what you have measured, once: whoever reads the message must know which numbers are meant.",
    )
    triples = triples_in(numbers)
    right = [triple for triple in triples if is_near(triple, means)]
    call.require(
        bool(right),
        expected=f"a message with the mean angular velocity {shown_vector(means)} rad/s, within {TOLERANCE:g}",
        observed=f"message: {shown(message)}",
        help=advice_on_vector(call, [[float(one) for one in triple] for triple in triples], means)
        or "Put the three means into the message, x, y and z, as plain numbers in rad/s with at least four decimals.",
    )
    call.require(
        any(max(map(decimals, triple)) >= DECIMALS for triple in right),
        expected=f"the means with at least {DECIMALS} decimals",
        observed=f"message: {shown(message)}",
        help="Round later: a bias of some thousandths needs four decimals or more, as in f'{x:.5f}'.",
    )
    return _situation(call)


@obligation(5, 8, of=those(*SUCCEEDS))
def tells_the_count(call: Call) -> str | None:
    """The message holds the number of samples, which are those of this calibration"""
    if not call.response.success:
        return None
    story, run = story_of(call), call.run
    assert story
    came = len(imu_between(run, story.since - DELIVERY / 2, call.answered.t))
    counts = whole_numbers(call.response.message)
    more = [count for count in counts if count > came]
    call.require(
        any(FEWEST_SAMPLES <= count <= came for count in counts),
        expected=f"the count of samples in the message: {FEWEST_SAMPLES} or more, and {came} at most could come",
        observed=f"message: {shown(call.response.message)}",
        help=f"{more[0]} samples are more than those of this calibration: begin each one with an empty list."
        if more
        else "Put the number of samples that you averaged into the message.",
    )
    return _situation(call)


@obligation(3, 5, of=whole_run)
def collects_for_three_seconds(run: Transcript) -> str | None:
    """The count is that of 3 s of samples"""
    whole = [call for call in those(truth.PROMPT, truth.SLOW, truth.SAYS_NO)(run) if call.response.success]
    said = [count for call in whole for count in whole_numbers(call.response.message)]
    counts = [count for count in said if FEWEST_SAMPLES <= count <= 2 * RATE * COLLECTING]
    if len(whole) < SEVERAL or not counts:
        return None
    due = RATE * COLLECTING
    nearest = min(counts, key=lambda count: abs(count - due))
    whole[-1].require(
        abs(nearest - due) <= SHARE * due,
        expected=f"the samples of {COLLECTING:g} s, {due:g} or nearly as many",
        observed=f"{nearest} at best, of {len(whole)} calibrations",
        help="Average every sample that comes in the 3 s, and no other, and tell how many these are.",
    )
    return "several"


@obligation(6, of=those(*SUCCEEDS), see="01_robot_and_graph#conventions")
def publishes_the_means(call: Call) -> str | None:
    """Each success publishes one message on imu_bias: the means of its message, in frame imu_link"""
    if not call.response.success:
        return None
    answered, run, means = call.answered, call.run, _means(call)
    earliest, latest = answered.t - LATEST_BEFORE, answered.t + DELIVERY
    published = [event for event in run.received("imu_bias") if earliest <= event.t <= latest]
    call.require(
        len(published) == 1,
        expected="one message on imu_bias for each success, within 1 s of the answer",
        observed=f"{len(published)} messages" if published else published_instead(run),
        help="Publish once, when all is known to be well, just before you answer success: true."
        if published
        else "Make the publisher of imu_bias in the constructor, and publish one Vector3Stamped before you answer.",
    )
    _require_bias(call, published[0].message, means)
    return _situation(call)


@obligation(7, of=whole_run, see="01_robot_and_graph#late-why")
def latches_the_bias(run: Transcript) -> str | None:
    """imu_bias is latched: a node that subscribes later gets the last one"""
    done = [call for call in those(*SUCCEEDS)(run) if call.response.success]
    if not done:
        return None
    heard = run.received("imu_bias")
    done[-1].require(
        bool(heard),
        expected="the last imu_bias, sent to a node that subscribes after the calibration",
        observed="none",
        help="Give the publisher durability TRANSIENT_LOCAL: it keeps the last message for those who come later.",
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
        expected="the same means in message and imu_bias, but for rounding",
        observed=f"imu_bias {shown_vector(found)}, message: {shown(call.response.message)}",
        help="Compute the means once, and round them only for the message, to four decimals or more.",
    )
    call.require(
        header.frame_id == "imu_link",
        expected="header.frame_id 'imu_link': the bias is that of the sensor, about its axes",
        observed=f"header.frame_id {shown(header.frame_id)}",
        help='Set header.frame_id = "imu_link" before you publish.',
        see="01_robot_and_graph#frames-why",
    )


def _require_silence(call: Call) -> None:
    """Require that imu_bias stayed silent from a request until shortly after its answer, but for others' successes."""
    run = call.run
    others = [other.answer for other in calls(SERVICE)(run) if other.name != call.name and other.answer]
    successes = [answer.t for answer in others if answer.response.success]
    for event in run.received("imu_bias"):
        excused = any(end - LATEST_BEFORE <= event.t <= end + DELIVERY for end in successes)
        if call.sent.t <= event.t <= call.answered.t + DELIVERY and not excused:
            vector = event.message.vector
            raise Failure(
                expected="nothing on imu_bias, as there was no calibration",
                observed=f"{shown_vector((vector.x, vector.y, vector.z))} was published",
                help="Publish on imu_bias only when all is known to be well, just before you answer success: true.",
                at=event.t,
            )


def _means(call: Call) -> tuple[float, ...]:
    """Return the means (rad/s) of what the robot published on imu while a calibration collected."""
    story = story_of(call)
    assert story
    samples = [each.angular_velocity for each in imu_between(call.run, story.since, call.answered.t)]
    return tuple(sum(each[axis] for each in samples) / max(1, len(samples)) for axis in range(3))


def _rounding(triple: Sequence[str]) -> float:
    """Return by how much (rad/s) numbers that are written so may have been rounded or cut off."""
    return max(1e-6, 1.1 * 10.0 ** -max(0, *map(decimals, triple)))


def _situation(call: Call) -> str:
    story = story_of(call)
    return f"{story.situation}, after {story.after or 'nothing'}" if story else ""
