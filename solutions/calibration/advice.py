"""Advice for failures: why a calibration should have ended differently, and which mistake explains a wrong mean."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from autograder.authoring import Call, Transcript, ev, shown_fields, why_no_message_arrives

from . import truth
from .message import TOLERANCE, is_near, whole_numbers
from .truth import ASKING, CLOCK_SLACK, COLLECTING, FEWEST_SAMPLES, Story, imu_between, status_requests

AT_ONCE_TIME = 0.5  # s; a rejection that came sooner did not wait for anything
GRAVITY = 9.81  # m/s²
_LIMIT = "Wait at most 2 s for get_status in total, then send the response with success false."
_BUSY = (
    "At the start of the callback, before any await, record that a calibration is running; until its response, reject "
    "other requests."
)
_TO_THE_END = "Check robot_state until the 3 s are over, not only when the request comes."

REASONS = {  # by situation: why a request is rejected or fails, and the advice if it is not
    truth.UNKNOWN: (
        "no robot_state had come",
        "Initialise the stored state with None, and reject requests while it is None.",
    ),
    truth.WALKS: (
        "the robot was WALKING",
        "Reject the request if the mode in the last robot_state is RobotState.WALKING.",
    ),
    truth.ASKS: ("the calibration of another client was waiting for get_status", _BUSY),
    truth.COLLECTS: ("the calibration of another client was collecting samples", _BUSY),
    truth.SILENT: ("get_status did not respond", _LIMIT),
    truth.ANSWERED_LATE: ("get_status did not respond within 2 s", _LIMIT),
    truth.ANOTHERS_ANSWER: (
        "its own request to get_status had no response within 2 s",
        "Wait only for the future of this request; after 2 s call remove_pending_request with it.",
    ),
    truth.MISSING: (
        "there was no server of get_status",
        "Give wait_for_service a timeout_sec, or do not call it.",
    ),
    truth.WALKED_ON: ("the robot began to walk while the samples were collected", _TO_THE_END),
    truth.WALKED_SHORTLY: (
        "the robot walked while the samples were collected",
        "Record in the callback of robot_state that the robot walked: at the end it may stand again.",
    ),
    truth.NO_SAMPLES: (
        "no imu messages came",
        "Check that there are at least 100 samples before you divide by their number.",
    ),
    truth.FEW_SAMPLES: (
        "fewer than 100 imu messages came",
        "Fail with fewer than 100 samples, not only with none, and start each calibration with an empty list.",
    ),
}


def advice_on_failing(call: Call, story: Story, published: int) -> str:
    """Return advice on a calibration that should have succeeded; `published` imu messages came during it."""
    said = shown_fields(call.response, "message")
    for topic in ("imu", "robot_state"):
        if cause := why_no_message_arrives(call.run, topic):
            return cause
    waited, asked = call.latency, status_requests(call)
    if asked and story.situation == truth.SAYS_NO:
        return (
            f"get_status responded with success false, and your response was {said}: go on after any response of "
            "get_status."
        )
    if waited < AT_ONCE_TIME:
        return (
            f"Your server rejected the request at once ({said}): check the conditions anew for each request, and in a "
            "finally block record that no calibration is running."
        )
    if not asked and call.run.all(ev.ServiceOffered):
        return f"No request came to the grader's get_status ({said}): check that your callback reaches call_async."
    if story.situation == truth.SLOW and waited < COLLECTING:
        after = story.since - call.sent.t
        return (
            f"get_status responded after {after:.1f} s, your server after {waited:.1f} s ({said}): wait {ASKING:g} s "
            "for get_status."
        )
    if ASKING - CLOCK_SLACK <= waited < COLLECTING:
        return (
            f"get_status had responded, but your server did not process the response ({said}): give client and service "
            "a ReentrantCallbackGroup."
        )
    if any(FEWEST_SAMPLES <= count <= published for count in whole_numbers(call.response.message)):
        return (
            f"Your server had at least {FEWEST_SAMPLES} samples, which is enough ({said}): do not require more, as "
            "some messages get lost."
        )
    if published >= FEWEST_SAMPLES and waited >= COLLECTING:
        return (
            f"{published} samples came, but your server did not count them ({said}): use callback groups that let "
            "on_imu run while the service callback waits."
        )
    return f"Your response was {said}: reject requests only for the reasons in the task."


def advice_on_vector(call: Call, triples: Sequence[Sequence[float]], means: Sequence[float]) -> str | None:
    """Return the known mistake that explains one of the triples, given the right means (rad/s), or None."""
    run = call.run
    now = imu_between(run, call.sent.t, call.answered.t)
    earlier = [event.command["bias"] for event in run.all(ev.RobotCommanded) if "bias" in event.command]
    for triple in triples:
        if is_near([value / max(len(now), 1) for value in triple], means, TOLERANCE / 5):
            return "These are the sums: divide them by the number of samples."
        if is_near([value / 57.29578 for value in triple], means, TOLERANCE / 5):
            return "These are degrees per second: leave out the conversion, as imu and the response are in rad/s."
        if is_near([-value for value in triple], means):
            return "The signs are inverted: the bias is the mean itself, not its negative."
        if is_near(sorted(triple), sorted(means)):
            return "The values are right, but not in the order x, y, z."
        if math.dist(triple, (0.0, 0.0, GRAVITY)) < 2.0:
            return "These are accelerations: use angular_velocity of each message."
        if any(_is_mixed(triple, means, other) for other in earlier[:-1]):
            return "This mean includes earlier samples: after each response of get_status, start with an empty list."
        if not any(triple):
            return "A mean of exactly 0 is not from samples: compute the mean of those that on_imu has collected."
    return None


def published_instead(run: Transcript) -> str:
    """Return, in words, what the node publishes instead of imu_bias."""
    others = [name for topics in run.all(ev.NodeTopics) for name in topics.publishes]
    names = sorted({name for name in others if not name.endswith(("/rosout", "/parameter_events"))})
    return "no message" + (f"; your node publishes {', '.join(names)}" if names else "")


def _is_mixed(found: Sequence[float], means: Sequence[float], other: Sequence[float]) -> bool:
    """Return whether `found` is a mean of samples with two biases (rad/s), or with the other bias alone."""
    way, part = np.subtract(means, other), np.subtract(found, other)
    if not any(way):
        return False
    share = part @ way / (way @ way)
    return 0.0 <= share <= 1.0 and is_near(list(part), list(share * way))
