"""What each request to calibrate has to come to, by what robot, imu and get_status did meanwhile.

Where that cannot be told, as something may have been on its way, there is no story: either end is right.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from autograder.authoring import DELIVERY, STEPS, Call, Request, Transcript, calls, ev, steps_until, unseen
from ros_runtime.message_constants import RobotMode

SERVICE = "calibrate_imu"
ASKING = 2.0  # s, at most, for get_status
COLLECTING = 3.0  # s
FEWEST_SAMPLES = 100
DISCOVERY = 3.0  # s for a server that was started again to be known
TOGETHER = 0.3  # s: which of two requests comes first nobody can tell
IN_TIME, LATE = 1.6, 2.5  # s: a reply of get_status that is certainly in time, and one that certainly is not
CLOCK_SLACK = 0.1  # s less than it should take: clocks are read at either end
SURELY_WALKED = 0.2  # s of the 3 s
SURELY_FEW, SURELY_ENOUGH = 85, 115  # samples: some may be lost, and some may be on their way
ALL_SAMPLES = 145  # of 150 in 3 s

UNKNOWN = "before the first robot_state"
WALKS = "while it walks"
ASKS = "while another asks get_status"
COLLECTS = "while another collects"
MISSING = "nobody offers get_status"
SILENT = "get_status is silent"
ANSWERED_LATE = "get_status answers too late"
ANOTHERS_ANSWER = "get_status answers an earlier request"
WALKED_ON = "it begins to walk"
WALKED_SHORTLY = "it walks for a moment"
NO_SAMPLES = "no sample"
FEW_SAMPLES = "some samples"
PROMPT = "get_status answers at once"
SLOW = "get_status is slow"
SAYS_NO = "get_status answers success: false"
ENOUGH_SAMPLES = "some samples are missing"


@dataclass(frozen=True)
class Story:
    """What a request has to come to.

    Attributes:
        end: it is refused at once, fails, or succeeds.
        situation: why.
        since: when (s) get_status answered, and collecting begins; NaN, if it does not.
        after: how the calibration before it ended; "" for the first.
    """

    end: Literal["is refused", "fails", "succeeds"]
    situation: str
    since: float = math.nan
    after: str = ""


def those(*situations: str, after: str = "") -> Callable[[Transcript], list[Call]]:
    """Occasions: the requests in one of these situations, `after` a calibration that ended so."""

    def occasions(run: Transcript) -> list[Call]:
        told = ((call, story_of(call)) for call in calls(SERVICE)(run))
        return [
            call
            for call, story in told
            if story and story.situation in situations and (not after or after == story.after)
        ]

    return occasions


def story_of(call: Call) -> Story | None:
    """Return what a request has to come to; None if nobody can tell."""
    run, sent, end = call.run, call.sent.t, _end_of(call)
    known_from = _states_from(run)
    if end <= known_from:
        return Story("is refused", UNKNOWN)
    before = run.robot_between(sent - DELIVERY, sent)
    if known_from > sent - DELIVERY or {robot.mode for robot in before} - {
        RobotMode.STANDING,
        RobotMode.WALKING,
    }:
        return None
    handled = run.robot_between(sent - DELIVERY, min(end, sent + DELIVERY))
    if all(robot.mode == RobotMode.WALKING for robot in handled):
        return Story("is refused", WALKS)
    if any(robot.mode == RobotMode.WALKING for robot in before):
        return None
    for other in _at_work(call):
        story = story_of(other)
        if story is None or (story.end != "is refused" and _end_of(other) < sent + DELIVERY / 4):
            return None
        if story.end != "is refused":
            return Story("is refused", ASKS if not story.since <= sent + DELIVERY / 4 else COLLECTS)
    return _calibration(call)


def imu_between(run: Transcript, start: float, end: float) -> list[ev.ImuPublished]:
    """Return what the robot published on imu between two times (s)."""
    return [sample for sample in run.all(ev.ImuPublished) if start <= sample.t <= end]


def status_requests(call: Call) -> list[Request]:
    """Return the requests to get_status from a request to calibrate to its answer."""
    asked = call.run.requests("get_status")
    return [request for request in asked if call.sent.t <= request.received.t <= _end_of(call)]


def _end_of(call: Call) -> float:
    return call.answer.t if call.answer else call.run.end


def _states_from(run: Transcript) -> float:
    """Return from when (s) on the robot published its state."""
    if all(verb != "publish_robot_state" for verb, *_ in run.params.get("steps", ())):
        return -math.inf
    return min((event.t for event in run.commands("robot_state")), default=math.inf)


def _at_work(call: Call) -> list[Call]:
    """Return the other requests that were not answered yet when this one came.

    Of those that come together one may calibrate: the one that did, or else the first.
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
    """Return what a request comes to that is not refused."""
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
        still = walked[-1] > over - DELIVERY  # a node may believe at the end that it walks
        return Story("fails", WALKED_ON if still else WALKED_SHORTLY, since, after)
    if _walking(run, sent, _end_of(call)):
        return None
    ended = _end_of(call)
    published = len(imu_between(run, since, over))
    if len(imu_between(run, since - DELIVERY / 4, max(over, ended))) <= SURELY_FEW:
        return Story("fails", FEW_SAMPLES if published else NO_SAMPLES, since, after)
    if ended < over - DELIVERY / 4:  # the robot stood, and imu may have been unplugged only later
        usual = ALL_SAMPLES * (ended - since) / COLLECTING - 1
        if len(imu_between(run, since, ended)) < usual:
            return None
        return Story("succeeds", situation, since, after)
    if published < SURELY_ENOUGH:
        return None
    return Story("succeeds", situation if published >= ALL_SAMPLES else ENOUGH_SAMPLES, since, after)


def _status(call: Call) -> tuple[str, float] | None:
    """Return what get_status does, and when (s) it answers: NaN, if not in time."""
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
    """Return what get_status would have done, had it been asked."""
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
    """Return how the last calibration that ended before a request came out."""
    answers = [other.answer for other in calls(SERVICE)(call.run) if other.answer]
    ended = [(answer.t, answer.response.success) for answer in answers if answer.t <= call.sent.t]
    return ("a success" if max(ended)[1] else "a failure") if ended else ""
