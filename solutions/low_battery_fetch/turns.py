"""The right next step of a fetch, at each turn: when the fetch begins, and when each of its children has ended."""

from __future__ import annotations

import math
from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass
from functools import reduce
from itertools import product

from geometry_msgs.msg import Quaternion

from autograder.authoring import (
    ABORTED,
    CANCELED,
    SUCCEEDED,
    Failure,
    Transcript,
    differing_fields,
    ev,
    expect,
    expect_field,
    require_alive,
    shown,
    unseen,
    where_it_waited,
    why_rclpy_aborted,
)
from ros_runtime.message_constants import GoalStatus, name_of

from . import fetching
from .fetching import HOME, NAVIGATE, PICK, PUT, SILENCE, SLACK, TABLE, TAKE, Child, Fetch

AT_ONCE_TIME = 2.5  # s for a step that must follow at once, and by which 5 s may be exceeded
PLACES = {TABLE: (1.2, 0.0), HOME: (0.0, 0.0), TAKE: (1.45, 0.0, 0.72)}  # m in odom
PREEMPTED = 6
# Reasons for a next step.
BEGINS, LOW_BEFORE, UNKNOWN = (
    "the battery is not low",
    "the battery was low before the goal",
    "the battery's level is unknown",
)
AT_TABLE, ON_TRAY, AT_HOME = "the robot is at the table", "the object is on the tray", "the robot is home"
LOW_AWAY, LOW_AT_HOME, DONE = (
    "the battery is low",
    "the battery is low and the robot is home",
    "all steps are done",
)
IS_CANCELED, IS_PREEMPTED, FAILED = "fetch was canceled", "a newer goal came", "a child failed"
UNANSWERED, SILENT, NO_SERVER = (
    "a goal had no response for 5 s",
    "a child had no feedback for 5 s",
    "there is no server",
)
DEADLOCK = (
    "Waiting for a child in a callback blocks the only thread, so the child's response is never processed. Await the "
    "future in an async execute callback, or use a MultiThreadedExecutor and callback groups that allow both callbacks "
    "at the same time."
)
LATCHED = "subscribe to it with QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL), which is reliable."
ACCEPT = "A rejection carries no reason: accept the goal, then abort it with the reason in error_msg."
NEXT_STEP = (
    "The order is: to the table, take the object, home, put it down. After each child, check whether "
    "the child failed, fetch is canceled or preempted, or the battery is low."
)


@dataclass(frozen=True)
class End:
    """A possible end of a fetch: its status, words in error_msg, its error_code (None: any), and its time (s)."""

    status: int
    words: tuple[str, ...] = ()
    code: int | None = None
    soonest: float = 0.0
    latest: float = math.inf


@dataclass(frozen=True)
class Plan:
    """The reason for a turn, and the moves that are right: steps or ends."""

    why: str
    moves: tuple[str | End, ...]

    def move(self, made: Child | ev.ResultReceived | None) -> str | End | None:
        """Return which of `moves` was made, by its action or status, or None."""
        for each in self.moves:
            if isinstance(each, End) and isinstance(made, ev.ResultReceived) and each.status == made.status:
                return each
            if isinstance(each, str) and isinstance(made, Child) and fetching.ACTION_OF[each] == made.action:
                return each
        return None

    def __str__(self) -> str:
        ways = [
            _in_words(each) if isinstance(each, End) else f"a goal to {fetching.ACTION_OF[each]}: {each}"
            for each in self.moves
        ]
        return f"{' or '.join(ways)}, because {self.why}"


@dataclass(frozen=True, eq=False)
class Turn:
    """A time at which a fetch has to decide: at its start, or when a child has ended.

    `after` is the child that has ended, None at the start; `t` is the time (s), `plan` has the right moves, and `made`
    is the move that the server made: the next child, the result, or None.
    """

    fetch: Fetch
    after: Child | None
    made: Child | ev.ResultReceived | None
    t: float
    plan: Plan


def turns(*whys: str) -> Callable[[Transcript], list[Turn]]:
    """Occasions: the decisions of every fetch that have one of these reasons; by default all of them."""
    return lambda run: [
        turn for fetch in fetching.fetches(run) for turn in _turns(fetch) if turn.plan.why in whys or not whys
    ]


# -- the right moves -------------------------------------------------------------------------------------------------


def _turns(fetch: Fetch) -> list[Turn]:
    found: list[Turn] = []
    end = fetch.goal.result
    sent = [child for child in fetch.children if end is None or child.t <= end.t]
    for after, made in zip((None, *sent), (*sent, end), strict=True):
        t = fetch.begun if after is None else _over(after)
        certain = (made.t if isinstance(made, Child) else t) - SLACK
        at = made.t if made else fetch.run.end
        options = [
            (False,) if moment is None or moment > at else (True,) if moment <= certain else (True, False)
            for moment in (fetch.canceled_at, fetch.preempted_at, fetch.low_at)
        ]
        plans = [plan for flags in product(*options) if (plan := _plan(fetch, after, t, *flags))]
        if plans:
            plan = next((plan for plan in plans if plan.move(made)), plans[0])
            found.append(Turn(fetch, after, made, t, plan))
    return found


def _over(child: Child) -> float:
    """Return when (s) a fetch knows that a child has ended, or no longer has to wait for it."""
    if child.is_late:
        return child.t + SILENCE
    if child.silent_at is not None:
        asked = [each.received.t for each in child.cancels()]
        given_up = min((t for t in asked if t >= child.silent_at - SLACK), default=child.silent_at) + SILENCE
        return min(given_up, math.inf if child.ended is None or child.is_dead else child.ended)
    return child.run.end if child.ended is None else child.ended


def _plan(fetch: Fetch, after: Child | None, t: float, *reasons: bool) -> Plan | None:
    """Return the plan at a time (s), given whether fetch is canceled, preempted, low on battery; None: unspecified."""
    canceled, preempted, low = reasons
    stopped = canceled or preempted
    unclear = stopped and after and (after.is_late or after.rejected or after.silent_at)
    if (after is None and low and not stopped) or unclear or (after and after.is_silent_after_a_cancel):
        return None  # no clause says which of the two reasons counts
    if stopped:
        ends = (End(CANCELED, latest=t + AT_ONCE_TIME), End(ABORTED, code=PREEMPTED, latest=t + AT_ONCE_TIME))
        return Plan(IS_CANCELED if canceled else IS_PREEMPTED, ends[not canceled : 1 + preempted])
    given_up = (End(ABORTED, ("battery",), latest=t + AT_ONCE_TIME),)
    if after is None:
        level = fetch.level(fetch.begun)
        if level and not fetching.is_low(level):
            return _next(fetch, TABLE, BEGINS, t)
        return Plan(LOW_BEFORE if level else UNKNOWN, given_up)
    if failure := _failure_of(after, t, low):
        return failure
    done = after.sent.finished is not None and after.sent.finished.status == SUCCEEDED
    if after.step == PUT and done:
        return Plan(DONE, (End(SUCCEEDED, latest=t + AT_ONCE_TIME),))
    if low or not done:
        return Plan(LOW_AT_HOME, given_up) if after.step in (HOME, PUT) else _next(fetch, HOME, LOW_AWAY, t)
    return _next(
        fetch, *{TABLE: (TAKE, AT_TABLE), TAKE: (HOME, ON_TRAY), HOME: (PUT, AT_HOME)}[after.step], t
    )


def _next(fetch: Fetch, step: str, why: str, t: float) -> Plan:
    """Return the plan with this step, or with the end if its server is missing for 5 s.

    At the start, fetch may also check for both servers.
    """
    given_up = t + SILENCE
    missing = {
        action: End(ABORTED, (action,), soonest=given_up - SLACK, latest=given_up + AT_ONCE_TIME)
        for action in (NAVIGATE, PICK)
        if not fetching.is_offered(fetch.run, action, t, given_up)
    }
    if fetching.ACTION_OF[step] in missing:
        return Plan(NO_SERVER, (missing[fetching.ACTION_OF[step]],))
    return Plan(why, (step, *(missing.values() if step == TABLE else ())))


def _failure_of(child: Child, t: float, low: bool) -> Plan | None:
    """Return the plan after a child that failed, or None if it has not failed."""
    name, end = child.action, child.sent.finished
    if child.is_late:
        return Plan(UNANSWERED, (End(ABORTED, (name,), soonest=t - SLACK, latest=t + AT_ONCE_TIME),))
    if child.rejected:
        return Plan(FAILED, (End(ABORTED, (name,), latest=t + AT_ONCE_TIME),))
    if child.silent_at is not None:
        soonest, latest = (0.0, t + 3 * AT_ONCE_TIME) if child.is_dead else (t - SLACK, t + AT_ONCE_TIME)
        return Plan(SILENT, (End(ABORTED, (name,), soonest=soonest, latest=latest),))
    if end is None or end.status == SUCCEEDED or (end.status == CANCELED and child.cancels()):
        return None
    said = (end.result.error_msg,) if end.result.error_msg else ()
    code = end.result.error_code if name == PICK and end.status == ABORTED else None
    aborted = End(ABORTED, (name, *said), code, latest=t + AT_ONCE_TIME)
    if low and child.cancels():
        return None if child.step == PUT else Plan(FAILED, (aborted, HOME))
    return Plan(FAILED, (aborted,))


# -- the moves that were made ----------------------------------------------------------------------------------------


def require_turn(turn: Turn) -> str:
    """Require that a fetch made a right move after its child had ended, with the right message; return the step."""
    fetch, made, plan = turn.fetch, turn.made, turn.plan
    fetch.goal.require_accepted(ACCEPT)
    if turn.after and made:
        require_over(turn.after, made)
    move = plan.move(made)
    if made is None or move is None:
        raise _not_made(turn)
    if isinstance(move, End) and isinstance(made, ev.ResultReceived):
        _require_end(turn, move, made)
    elif isinstance(made, Child):
        expect(
            made.t >= turn.t - SLACK,
            expected="the first child of a newer goal after the result of the old goal",
            observed=f"{_in_words(made)} {turn.t - made.t:.1f} s before that",
            help="Run one fetch at a time: before the new goal sends anything, wait until the old goal has ended.",
            at=made.t,
        )
        _require_message(fetch, made)
    return f"{turn.after.step} {turn.after.stage(turn.t)}".strip() if turn.after else "at the beginning"


def require_over(child: Child, made: Child | ev.ResultReceived) -> None:
    """Require that a child had ended, or sent no feedback for too long, when fetch made the next move."""
    patient = child.silent_at is not None and made.t >= _over(child) - SLACK
    asked = f"your server sent {len(child.sent.cancels)} cancel request(s)"
    expect(
        patient
        or child.is_late
        or child.began is None
        or (child.ended is not None and child.ended <= made.t),
        expected=f"no other goal and no result of fetch while {child.action} is active ({child.step})",
        observed=f"{_in_words(made)} while {child.action} was still active; {asked}",
        help="Wait for the child's result with get_result_async(), also after cancel_goal_async(): the response to a "
        "cancel says only that the server will try to stop.",
        at=made.t,
    )


def _not_made(turn: Turn) -> Exception:
    """Return the exception for a fetch that made a wrong move, or none."""
    goal, made, after = turn.fetch.goal, turn.made, turn.after
    if made is None:
        require_alive(goal.run)
    if made is None and after and after.ended is None and after.silent_at is None and not after.is_late:
        return unseen(turn.fetch.run, f"{after.sent.name} of {after.action} did not end")
    if not isinstance(made, Child) and isinstance(turn.plan.moves[0], End):
        goal.require_result(turn.plan.moves[0].status)
    return Failure(
        expected=str(turn.plan),
        observed=_in_words(made) if made else "neither a goal nor a result",
        help=NEXT_STEP if isinstance(made, Child) else _why_it_stopped(turn),
        at=made.t if made else goal.run.end,
    )


def _in_words(made: Child | ev.ResultReceived | End) -> str:
    if isinstance(made, Child):
        return f"a goal to {made.action}"
    return f"the result of fetch, {name_of(GoalStatus, made.status)}"


def _require_end(turn: Turn, end: End, result: ev.ResultReceived) -> None:
    """Require that a fetch's result has the right error_msg, error_code and time."""
    why, said = turn.plan.why, result.result.error_msg
    if result.status == ABORTED and (unmeant := why_rclpy_aborted(turn.fetch.goal)):
        aborted = "rclpy aborted the goal"
        raise Failure(
            expected=f"your own abort(), because {why}", observed=aborted, help=unmeant, at=result.t
        )
    expect(
        all(word.lower() in said.lower() for word in end.words),
        expected=f"an error_msg that contains {' and '.join(map(shown, end.words))}, because {why}",
        observed=f"error_msg: {shown(said)}",
        help="Write into result.error_msg what happened, in words, before you call abort().",
        at=result.t,
    )
    if end.code is not None:
        help = "Copy error_code from the child's result into yours; after a newer goal, set it to PREEMPTED."
        expect_field(result.result, "error_code", end.code, because=why, help=help, at=result.t)
    expect(
        end.soonest <= result.t <= end.latest,
        expected=f"the result of fetch between {max(end.soonest, turn.t):.1f} and {end.latest:.1f} s, because {why}",
        observed=f"it came at {result.t:.1f} s",
        help="Count the 5 s from the child's acceptance or last feedback, and another 5 s from your cancel request. "
        "Call succeed(), abort() or canceled() and return as soon as there is nothing left to wait for.",
        at=result.t,
    )


def _why_it_stopped(turn: Turn) -> str:
    goal = turn.fetch.goal
    if unmeant := why_rclpy_aborted(goal):
        return unmeant
    if turn.plan.why == LOW_AWAY:
        return "When the child has ended, send navigate_to_pose the goal HOME and wait for its result before abort()."
    if goal.result and (said := goal.result.result.error_msg):
        gave_up = f"Your server aborted the goal, with error_msg {shown(said)}"
        levels = [each for each in turn.fetch.run.published("battery_state") if each.t <= goal.sent.t]
        if turn.after is None and len(levels) == 1 and "battery" in said:
            return f"{gave_up}. battery_state came once, before the goal: {LATCHED}"
        return f"{gave_up}: find out why."
    if goal.result:
        return "execute ended the goal too early: when a child has SUCCEEDED, go on with the next step."
    if place := where_it_waited(goal.run):
        return f"execute was waiting in {place}. {DEADLOCK}"
    if turn.after and turn.after.sent.result_requested is None and turn.after.began is not None:
        return "Request the child's result with get_result_async() as soon as it is accepted."
    return DEADLOCK


def _require_message(fetch: Fetch, child: Child) -> None:
    """Require that a child's goal has the fields of its step; fields without a clause may have any value."""
    sent, wanted = child.sent.message, deepcopy(child.sent.message)
    place = wanted.pose if child.action == NAVIGATE else wanted.place_pose
    place.header.frame_id, place.pose.orientation = "odom", Quaternion(w=1.0)
    for axis, value in zip("xyz", PLACES.get(child.step, ()), strict=False):
        setattr(place.pose.position, axis, value)
    if child.action == PICK:
        wanted.object_id, wanted.grasp_force = fetch.goal.request.object_id, fetch.goal.request.grasp_force
    if child.step == PUT:
        place.pose = fetch.goal.request.place_pose.pose
    for path in differing_fields(sent, wanted):
        expect_field(
            sent,
            path,
            reduce(getattr, path.split("."), wanted),
            because=f"this is the step “{child.step}”",
            help="Copy object_id and grasp_force from goal_handle.request. The task's table has the poses, in odom; a "
            "heading of 0 is orientation.w 1.0. The last step uses place_pose of fetch's own goal.",
            at=child.t,
        )
