"""Judges goals for a robot that the scenario plays: what it published, and what the server made of it."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry

from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

from .endings import require_given_up
from .leaning import UNEVEN
from .reports import SHIFTING, told
from .rising import CROUCHED, HEIGHT_SLACK, RISEN, require_accepted, require_success

EVEN = 0.78  # of the larger load, a little less than what is even: 0.8
EVEN_TIME, CALM_TIME = 0.3, 0.5  # s
EVEN_MOMENT = 0.2  # s, at most, until the next uneven load is published: far less than the time that counts
TIME_SLACK = 0.15  # s, that messages and rounds may be apart
TOLD = 0.5  # s for a change to show in the feedback
UNREST = 0.03  # m/s
TILT = 0.06  # rad

_ALREADY = "While nothing is known, reject: keep None until the first odom and the first wrench of each foot."


def require_rejected_until_known(run: Transcript, unknown: Goal, known: Goal) -> None:
    """Require that a goal is rejected before any message of the robot, and another accepted after some."""
    odoms = run.published("odom")
    between = [each for each in odoms if unknown.sent.t < each.t < known.sent.t]
    if not between or odoms[0] is not between[0]:
        raise unseen(run, "odom was not published as the scenario has it")
    unknown.require_rejected(because="no message of the robot has come yet", help=_ALREADY)
    expect(
        between[-1].subscriptions > 0,
        expected="a subscription to odom",
        observed="the grader published it, and nobody was subscribed",
        help='create_subscription(Odometry, "odom", …), a relative name.',
        at=between[-1].t,
    )
    known.require_accepted(
        "Now all is known: look at the last messages when the goal comes, not at the first."
    )


def require_even_for_a_while(run: Transcript, goal: Goal) -> None:
    """Require that the robot was not told to rise while its loads were even only now and then."""
    accepted, even = require_accepted(goal).accepted_at, run.mark("even")
    _require_swaying(run, goal.sent.t, even)
    rises = [each for each in run.heard("cmd_vel") if each.t >= accepted and each.message.linear.z > 0]
    first = rises[0].t if rises else math.inf
    expect(
        first >= even + EVEN_TIME - TIME_SLACK,
        expected=f"no linear.z above 0 before the loads have been even for {EVEN_TIME:g} s in a row",
        observed=f"the first came {even - first:.1f} s before they came to rest"
        if first < even
        else f"it came {first - even:.2f} s after they came to rest",
        help="Note when the loads became even, and forget it whenever they are not: the weight passes the middle also "
        "when it swings from foot to foot.",
        at=min(first, run.end),
    )
    require_success(goal)


def _require_swaying(run: Transcript, begin: float, end: float) -> None:
    """Require that between two moments (s) the loads were even for moments only, nearly even, and uneven both ways."""
    shares = _shares(run, begin, end)
    if not any(share < UNEVEN for _, share in shares) or not any(share > 1 / UNEVEN for _, share in shares):
        raise unseen(run, "the weight did not swing from foot to foot")
    nearly = [t for t, share in shares if UNEVEN < share < EVEN or 1 / EVEN < share < 1 / UNEVEN]
    if not nearly or nearly[-1] - nearly[0] < 2 * EVEN_TIME:
        raise unseen(run, "the loads were not nearly even for long enough")
    since = None
    for t, share in shares:
        if since is not None and t - since > EVEN_MOMENT:
            raise unseen(run, "the loads were even for too long")
        is_even = EVEN < share < 1 / EVEN
        since = (t if since is None else since) if is_even else None


def _shares(run: Transcript, begin: float, end: float) -> list[tuple[float, float]]:
    """Return, for each moment (s) of two, what the right foot carries as a share of the left foot's load."""
    left, right = (
        [each for each in run.published(f"{side}_foot/wrench") if begin <= each.t < end] for side in "lr"
    )
    return [
        (one.t, other.message.wrench.force.z / max(one.message.wrench.force.z, 1.0))
        for one, other in zip(left, right, strict=False)
    ]


def require_shifted_at_the_top(run: Transcript, goal: Goal) -> None:
    """Require that uneven loads lead back to shifting also from settling, and that success waits for them."""
    require_accepted(goal)
    uneven, even = run.mark("uneven"), run.mark("even")
    _require_up(run, goal, uneven)
    shares = _shares(run, uneven, even)
    if not shares or any(UNEVEN < share < 1 / UNEVEN for _, share in shares):
        raise unseen(run, "the loads were not uneven")
    _require_later(goal, even + EVEN_TIME - TIME_SLACK, "while one foot carried much more than the other")
    for feedback in told(goal, uneven + TOLD, even):
        expect(
            feedback.feedback.phase == SHIFTING,
            expected="the phase shifting while the loads are uneven",
            observed=f"{feedback.feedback.phase!r}",
            help="Look at the loads in every phase, also in settling.",
            at=feedback.t,
        )


def require_tired(run: Transcript, goal: Goal) -> None:
    """Require that the time limit counts once, from the acceptance, for a robot that never rises and shifts again."""
    accepted, uneven = require_accepted(goal).accepted_at, run.mark("uneven")
    heights = [each.message.pose.pose.position.z for each in run.published("odom") if each.t >= accepted]
    if (
        not heights
        or max(heights) > CROUCHED
        or any(share > UNEVEN for _, share in _shares(run, uneven, run.end))
    ):
        raise unseen(run, "the robot rose, or rested on both feet to the end")
    require_given_up(goal, accepted)


def require_calm(run: Transcript, goal: Goal) -> None:
    """Require that the goal succeeds only when the robot has been calm for a while."""
    require_accepted(goal)
    restless, calm = run.mark("restless"), run.mark("calm")
    _require_up(run, goal, calm)
    _require_unrest(run, restless, calm)
    least = (
        CALM_TIME - 2 * TIME_SLACK if run.params["calm"] else 0.0
    )  # else at once: it was never calm before
    _require_later(goal, calm + least, _unrest_in_words(run))


def _require_up(run: Transcript, goal: Goal, t: float) -> None:
    """Require that the played robot has risen by a time (s)."""
    odoms = [each for each in run.published("odom") if each.t <= t]
    if not odoms:
        raise unseen(run, "no odom was published")
    z = max(each.message.pose.pose.position.z for each in odoms)
    expect(
        z >= RISEN - HEIGHT_SLACK,
        expected=f"a robot that is told to rise to {RISEN} m",
        observed=f"it got to {z:.3f} m",
        help=why_rclpy_aborted(goal)
        or "Publish linear.z above 0 on cmd_vel again and again until odom's height is at least 0.59 m.",
        at=t,
    )


def _require_unrest(run: Transcript, begin: float, end: float) -> None:
    """Require that the played robot was never calm for 0.5 s between two moments (s)."""
    last = begin
    for each in [each for each in run.published("odom") if begin <= each.t <= end]:
        if _is_restless(each.message):
            last = each.t
        elif each.t - last > CALM_TIME - 0.1:
            raise unseen(run, "the robot was calm for too long")
    if last == begin or end - last > CALM_TIME - 0.1:
        raise unseen(run, "the robot was not restless")


def _is_restless(odom: Odometry) -> bool:
    velocity = odom.twist.twist.linear
    return math.hypot(velocity.x, velocity.y) > UNREST or tilt(odom.pose.pose.orientation) > TILT


def tilt(q: Quaternion) -> float:
    """Return the angle (rad) between the vertical and the z axis of an orientation."""
    return math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (q.x**2 + q.y**2))))


def _unrest_in_words(run: Transcript) -> str:
    speed, lean, calm = (run.params[name] for name in ("speed", "tilt", "calm"))
    words = [f"it moved at {speed:g} m/s"] if speed else []
    words += [f"it leaned by {lean:g} rad"] if lean else []
    return "while " + " and ".join(words) + (f", with pauses of {calm:g} s" if calm else "")


def _require_later(goal: Goal, t: float, when: str) -> None:
    """Require that a goal succeeds, and not before a time (s)."""
    result = require_success(goal)
    expect(
        result.t >= t,
        expected="success only when the robot has stood high, still and upright for 0.5 s in a row",
        observed=f"it SUCCEEDED {when}",
        help="Settling ends when height (0.59 m), speed (0.02 m/s) and tilt (0.05 rad) of odom have all been good for "
        "0.5 s: note since when, and forget it whenever one is not.",
        at=result.t,
    )


def require_bobbing(run: Transcript) -> None:
    """Require that the played robot, once it was up, went down by some millimetres now and then."""
    heights = _heights_at_the_top(run)
    if len(heights) < 2 or max(heights) - min(heights) < 0.002:
        raise unseen(run, "the robot did not bob")


def _heights_at_the_top(run: Transcript) -> Sequence[float]:
    begin, end = run.mark("restless"), run.mark("calm")
    heights = [each.message.pose.pose.position.z for each in run.published("odom") if begin <= each.t <= end]
    return heights[len(heights) // 2 :]
