"""The right outcome of each calibration request, from what robot, imu and get_status did during it.

If messages in transit make that uncertain, there is no `Story`, and either outcome is right.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from autograder.authoring import DELIVERY, STEPS, Call, Request, Transcript, calls, ev, steps_until, unseen
from ros_runtime.message_constants import RobotMode

SERVICE = "calibrate_imu"
ASKING = 2.0  # s, the longest wait for get_status
COLLECTING = 3.0  # s
FEWEST_SAMPLES = 100
DISCOVERY = 3.0  # s for a server that was started again to be discovered
TOGETHER = 0.3  # s; requests sent within this time may arrive in either order
IN_TIME, LATE = 1.6, 2.5  # s; a sooner response of get_status is certainly in time, a later one certainly not
CLOCK_SLACK = 0.1  # s, by which a measured duration may be too short, as two programs read the clock
SURELY_WALKED = 0.2  # s of walking, which every server must notice
SURELY_FEW, SURELY_ENOUGH = 85, 115  # samples, as some may be lost or in transit
ALL_SAMPLES = 145  # of 150 in 3 s

UNKNOWN = "before the first robot_state"
WALKS = "while the robot walks"
ASKS = "while another request waits for get_status"
COLLECTS = "while another request collects samples"
MISSING = "no server of get_status"
SILENT = "get_status does not respond"
ANSWERED_LATE = "get_status responds too late"
ANOTHERS_ANSWER = "get_status responds to an earlier request"
WALKED_ON = "the robot begins to walk"
WALKED_SHORTLY = "the robot walks for a moment"
NO_SAMPLES = "no samples"
FEW_SAMPLES = "fewer than 100 samples"
PROMPT = "get_status responds at once"
SLOW = "get_status responds slowly"
SAYS_NO = "get_status responds success: false"
ENOUGH_SAMPLES = "some samples are missing"


@dataclass(frozen=True)
class Story:
    """The right outcome of a request.

    Attributes:
        end: whether it is rejected at once, fails, or succeeds.
        situation: the reason.
        since: when (s) get_status responded and the collecting of samples begins; NaN if it did not respond.
        after: the outcome of the calibration before it; "" for the first.
    """

    end: Literal["is rejected", "fails", "succeeds"]
    situation: str
    since: float = math.nan
    after: str = ""


def those(*situations: str, after: str = "") -> Callable[[Transcript], list[Call]]:
    """Occasions: the requests in one of these situations, `after` a calibration with that outcome."""

    def occasions(run: Transcript) -> list[Call]:
        told = ((call, story_of(call)) for call in calls(SERVICE)(run))
        return [
            call
            for call, story in told
            if story and story.situation in situations and (not after or after == story.after)
        ]

    return occasions


def story_of(call: Call) -> Story | None:
    """Return the right outcome of a request; None if that is uncertain."""
    run, sent, end = call.run, call.sent.t, _end_of(call)
    known_from = _states_from(run)
    if end <= known_from:
        return Story("is rejected", UNKNOWN)
    before = run.robot_between(sent - DELIVERY, sent)
    if known_from > sent - DELIVERY or {robot.mode for robot in before} - {
        RobotMode.STANDING,
        RobotMode.WALKING,
    }:
        return None
    handled = run.robot_between(sent - DELIVERY, min(end, sent + DELIVERY))
    if all(robot.mode == RobotMode.WALKING for robot in handled):
        return Story("is rejected", WALKS)
    if any(robot.mode == RobotMode.WALKING for robot in before):
        return None
    for other in _at_work(call):
        story = story_of(other)
        if story is None or (story.end != "is rejected" and _end_of(other) < sent + DELIVERY / 4):
            return None
        if story.end != "is rejected":
            return Story("is rejected", ASKS if not story.since <= sent + DELIVERY / 4 else COLLECTS)
    return _calibration(call)


def imu_between(run: Transcript, start: float, end: float) -> list[ev.ImuPublished]:
    """Return the robot's imu messages between two times (s)."""
    return [sample for sample in run.all(ev.ImuPublished) if start <= sample.t <= end]


def status_requests(call: Call) -> list[Request]:
    """Return the requests to get_status between a calibration request and its response."""
    asked = call.run.requests("get_status")
    return [request for request in asked if call.sent.t <= request.received.t <= _end_of(call)]


def _end_of(call: Call) -> float:
    return call.answer.t if call.answer else call.run.end


def _states_from(run: Transcript) -> float:
    """Return when (s) the robot began to publish its state."""
    if all(verb != "publish_robot_state" for verb, *_ in run.params.get("steps", ())):
        return -math.inf
    return min((event.t for event in run.commands("robot_state")), default=math.inf)


def _at_work(call: Call) -> list[Call]:
    """Return the other requests without a response when this one came.

    Of requests that come together only one may calibrate: the one that succeeded, or else the first.
    """
    others = [other for other in calls(SERVICE)(call.run) if other.name != call.name]
    rivals = [other for other in others if abs(other.sent.t - call.sent.t) < TOGETHER]
    together = sorted([call, *rivals], key=lambda one: one.sent.t)
    winner = next((one for one in together if one.answer and one.answer.response.success), together[0])
    earlier = [other for other in others if other.sent.t <= call.sent.t - TOGETHER]
    return [
        *([winner] if winner.name != call.name else []),
        *(other for other in earlier if _end_of(other) > call.sent.t),
    ]


def _calibration(call: Call) -> Story | None:
    """Return the right outcome of a request that is not rejected."""
    run, sent = call.run, call.sent.t
    after = _end_before(call)
    status = _status(call)
    if status is None:
        return None
    situation, since = status
    if math.isnan(since):
        return Story("fails", situation, after=after)
    over = since + COLLECTING
    walked = [robot.t for robot in _walking(run, since + DELIVERY / 2, over - DELIVERY / 2)]
    if walked and walked[-1] - walked[0] >= SURELY_WALKED:
        still = walked[-1] > over - DELIVERY  # the last robot_state that the node received may be WALKING
        return Story("fails", WALKED_ON if still else WALKED_SHORTLY, since, after)
    if _walking(run, sent, _end_of(call)):
        return None
    ended = _end_of(call)
    published = len(imu_between(run, since, over))
    if len(imu_between(run, since - DELIVERY / 4, max(over, ended))) <= SURELY_FEW:
        return Story("fails", FEW_SAMPLES if published else NO_SAMPLES, since, after)
    if ended < over - DELIVERY / 4:  # it responded too early; the imu may have been unplugged only later
        usual = ALL_SAMPLES * (ended - since) / COLLECTING - 1
        if len(imu_between(run, since, ended)) < usual:
            return None
        return Story("succeeds", situation, since, after)
    if published < SURELY_ENOUGH:
        return None
    return Story("succeeds", situation if published >= ALL_SAMPLES else ENOUGH_SAMPLES, since, after)


def _status(call: Call) -> tuple[str, float] | None:
    """Return the situation of get_status, and when (s) it responds; NaN if not in time."""
    run, sent = call.run, call.sent.t
    ready = run.first(ev.NodeReady)
    withdrawn = {event.server: event.t for event in run.all(ev.ServiceWithdrawn)}
    offered = [(event.t, withdrawn.get(event.server, math.inf)) for event in run.all(ev.ServiceOffered)]
    if not any(start <= _end_of(call) and sent <= end for start, end in offered):
        return MISSING, math.nan
    known_from = max(ready.t if ready else 0.0, sent - DISCOVERY)
    if not any(start <= known_from and _end_of(call) <= end for start, end in offered):
        return None
    requests = status_requests(call)
    replies = [request.reply for request in requests if request.reply]
    if not requests:
        return _status_as_planned(call)
    if replies and replies[0].t <= sent + IN_TIME:
        slow = replies[0].t - requests[0].received.t > DELIVERY / 4
        said = replies[0].response.success
        return (SLOW if slow else PROMPT if said else SAYS_NO), replies[0].t
    if any(reply.t <= sent + LATE for reply in replies):
        return None
    if replies:
        return ANSWERED_LATE, math.nan
    steps = run.params.get(STEPS, ())
    if steps and not withdrawn and not any(step[0].startswith("status_") for step in steps):
        raise unseen(run, "the record lacks the reply of get_status")
    earlier = [request for request in run.requests("get_status") if request.received.t < sent]
    meanwhile = any(each.reply and sent < each.reply.t < sent + IN_TIME for each in earlier)
    return (ANOTHERS_ANSWER if meanwhile else SILENT), math.nan


def _status_as_planned(call: Call) -> tuple[str, float] | None:
    """Return what get_status would have done if it had been called."""
    begun = steps_until(call.run, call.sent.t)
    planned = [step for step in begun if step[0].startswith("status_")]
    if not planned:
        return PROMPT, call.sent.t
    verb, *after = planned[-1]
    if verb == "status_is_silent" or after[0] > LATE:
        return SILENT, math.nan
    if after[0] > IN_TIME:
        return None
    return (SAYS_NO if verb == "status_says_no" else SLOW if after[0] else PROMPT), call.sent.t + after[0]


def _walking(run: Transcript, start: float, end: float) -> list[ev.RobotTruth]:
    samples = run.robot_between(start, min(end, run.end))
    return [robot for robot in samples if robot.mode == RobotMode.WALKING and robot.t >= start]


def _end_before(call: Call) -> str:
    """Return the outcome of the last calibration before a request."""
    answers = [other.answer for other in calls(SERVICE)(call.run) if other.answer]
    ended = [(answer.t, answer.response.success) for answer in answers if answer.t <= call.sent.t]
    return ("a success" if max(ended)[1] else "a failure") if ended else ""
