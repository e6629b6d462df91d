"""What a calibration that goes wrong is told: why its end is wrong, and what kind of mistake makes such a mean."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from autograder.authoring import Call, Transcript, ev, shown_fields, why_no_message_arrives

from . import truth
from .message import TOLERANCE, is_near, whole_numbers
from .truth import ASKING, CLOCK_SLACK, COLLECTING, FEWEST_SAMPLES, Story, imu_between, status_requests

AT_ONCE_TIME = 0.5  # s for a refusal without looking into anything
GRAVITY = 9.81  # m/s²
_LIMIT = "Set one limit of 2 s to the wait for get_status, and answer when there is nothing by then."
_BUSY = "Note that a calibration runs as soon as it is asked for, before any await, and refuse others until its answer."
_TO_THE_END = "Look at robot_state until the 3 s are over, not only at the request."

REASONS = {  # why a request is refused or fails, by its situation, and what to do if it is not
    truth.UNKNOWN: (
        "no robot_state had come",
        "Begin with no state (None), and refuse as long as it is None.",
    ),
    truth.WALKS: (
        "the robot was WALKING",
        "Refuse while the mode in the last robot_state is RobotState.WALKING.",
    ),
    truth.ASKS: ("the calibration of another caller waited for get_status", _BUSY),
    truth.COLLECTS: ("the calibration of another caller was at work", _BUSY),
    truth.SILENT: ("get_status gave no answer", _LIMIT),
    truth.ANSWERED_LATE: ("get_status gave no answer within 2 s", _LIMIT),
    truth.ANOTHERS_ANSWER: (
        "its own request to get_status had no answer within 2 s",
        "Look at the future of this request only; forget it with remove_pending_request after 2 s.",
    ),
    truth.MISSING: ("nobody offers get_status", "Give wait_for_service a timeout_sec, or leave it out."),
    truth.WALKED_ON: ("the robot began to walk while the samples were collected", _TO_THE_END),
    truth.WALKED_SHORTLY: (
        "the robot walked while the samples were collected",
        "Remember in the callback of robot_state that it walked: at the end it may stand again.",
    ),
    truth.NO_SAMPLES: (
        "the imu was silent",
        "Compare the number of samples with 100 before you divide by it.",
    ),
    truth.FEW_SAMPLES: (
        "the imu was silent for so long that there were fewer than 100 samples",
        "Fail with fewer than 100 samples, not only with none, and begin each calibration with an empty list.",
    ),
}


def advice_on_failing(call: Call, story: Story, published: int) -> str:
    """Return what to do about a calibration that should have succeeded; imu came `published` times meanwhile."""
    said = shown_fields(call.response, "message")
    for topic in ("imu", "robot_state"):
        if deaf := why_no_message_arrives(call.run, topic):
            return deaf
    waited, asked = call.latency, status_requests(call)
    if asked and story.situation == truth.SAYS_NO:
        return f"get_status answered success: false, and your answer was {said}: any answer of it will do."
    if waited < AT_ONCE_TIME:
        return f"You refused at once ({said}): look again at each request, and forget a calibration however it ends."
    if not asked and call.run.all(ev.ServiceOffered):
        return f"The grader's get_status was never asked ({said}): did the request get as far as call_async?"
    if story.situation == truth.SLOW and waited < COLLECTING:
        after = story.since - call.sent.t
        return f"get_status answered after {after:.1f} s, you after {waited:.1f} s ({said}): wait {ASKING:g} s for it."
    if ASKING - CLOCK_SLACK <= waited < COLLECTING:
        return f"get_status had answered, but not to you ({said}): give client and service a ReentrantCallbackGroup."
    if any(FEWEST_SAMPLES <= count <= published for count in whole_numbers(call.response.message)):
        return f"{FEWEST_SAMPLES} samples are enough, and you had more ({said}): some messages of a sensor are lost."
    if published >= FEWEST_SAMPLES and waited >= COLLECTING:
        return (
            f"{published} samples came, but they were not counted ({said}): does on_imu get a turn meanwhile?"
        )
    return f"Your answer was {said}: refuse only for a reason that the task names."


def advice_on_vector(call: Call, triples: Sequence[Sequence[float]], means: Sequence[float]) -> str | None:
    """Return what kind of mistake makes one of the triples of the means (rad/s), if it is known."""
    run = call.run
    now = imu_between(run, call.sent.t, call.answered.t)
    earlier = [event.command["bias"] for event in run.all(ev.RobotCommanded) if "bias" in event.command]
    for triple in triples:
        if is_near([value / max(len(now), 1) for value in triple], means, TOLERANCE / 5):
            return "These are the sums: divide them by the number of samples."
        if is_near([value / 57.29578 for value in triple], means, TOLERANCE / 5):
            return "These are degrees: imu tells rad/s, and so do you."
        if is_near([-value for value in triple], means):
            return "The signs are the wrong way round: the bias is the mean itself."
        if is_near(sorted(triple), sorted(means)):
            return "The values are right, but not in the order x, y, z."
        if math.dist(triple, (0.0, 0.0, GRAVITY)) < 2.0:
            return "These are accelerations: take angular_velocity of each message."
        if any(_is_mixed(triple, means, other) for other in earlier[:-1]):
            return "Samples of before are in it: begin with an empty list each time, when get_status has answered."
        if not any(triple):
            return "A mean of exactly 0 comes from no sample: average what on_imu has collected."
    return None


def published_instead(run: Transcript) -> str:
    """Return what the node publishes, where nothing came on imu_bias."""
    others = [name for topics in run.all(ev.NodeTopics) for name in topics.publishes]
    names = sorted({name for name in others if not name.endswith(("/rosout", "/parameter_events"))})
    return "none" + (f"; your node publishes {', '.join(names)}" if names else "")


def _is_mixed(found: Sequence[float], means: Sequence[float], other: Sequence[float]) -> bool:
    """Return whether it is a mean of samples of two biases (rad/s), or of the other alone."""
    way, part = np.subtract(means, other), np.subtract(found, other)
    if not any(way):
        return False
    share = part @ way / (way @ way)
    return 0.0 <= share <= 1.0 and is_near(list(part), list(share * way))
