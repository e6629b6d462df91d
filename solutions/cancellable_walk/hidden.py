"""What only the instructor's grading checks."""

from __future__ import annotations

from autograder.authoring.checks import Scenario, check, expect
from autograder.authoring.goal import CANCELED, SUCCEEDED
from autograder.authoring.missing import unseen
from autograder.authoring.readiness import require_alive
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.planar import error
from autograder.authoring.walking.truth import (
    require_accepted,
    require_arrival,
    require_stopped,
    require_walking,
)

from .checks import arrives, cancels_in_mid_stride, stops_when_canceled


def _poses(random) -> dict:
    """Two poses less than a metre apart, the second partly behind the first.

    Both face backwards, to the same side, so that a velocity sent in odom's axes leads away on the whole second leg.
    """
    side = random.choice((-1, 1))
    first = (random.uniform(0.3, 0.6), random.uniform(-0.3, 0.3), side * random.uniform(1.9, 2.8))
    second = (
        first[0] - random.uniform(0.2, 0.4),
        first[1] + random.uniform(-0.3, 0.3),
        side * random.uniform(1.9, 2.8),
    )
    return {"poses": [[round(value, 3) for value in pose] for pose in (first, second)]}


RANDOM_POSES = Scenario("walk_in_turn", _poses)
AT_THE_START = Scenario("cancel_at_the_start")
SEVERAL_PHASES = Scenario(
    "cancel_in_mid_stride",
    lambda random: {"delays": [round(0.5 + 0.11 * k + random.uniform(0, 0.1), 3) for k in range(4)]},
)
NEAR_ARRIVAL = Scenario(
    "cancel_near_arrival", lambda random: {"distance": round(random.uniform(0.12, 0.2), 3)}
)
AFTER_THE_END = Scenario("cancel_after_the_end")
TWICE = Scenario("cancel_twice")
BY_A_STRANGER = Scenario("cancel_by_a_stranger")
NEAR = 0.1  # m the robot may have walked on, or back, until it was cancelled
OTHER_NAMESPACE = Scenario("walk", {"x": 0.3, "y": 0.0, "yaw": 0.0}, namespace="/lab_7/robot")


@check(points=2, on=RANDOM_POSES, needs=arrives, see="01_robot_and_graph#frames-intro")
def arrives_anywhere(run: Transcript) -> None:
    """It reaches poses with any heading, one after the other"""
    for number in range(1, len(run.params["poses"]) + 1):
        require_arrival(run.goal(f"leg {number}"))


@check(points=1, on=AT_THE_START, needs=cancels_in_mid_stride, see="07_cancel_and_preempt#m1-why")
def cancels_at_the_start(run: Transcript) -> None:
    """A cancel before execution, or at the first feedback, ends CANCELED with the robot still"""
    run.goal("at once").require_canceled()
    request = run.goal("first feedback").require_canceled()
    require_stopped(run, request.t)


@check(points=2, on=SEVERAL_PHASES, needs=stops_when_canceled, see="07_cancel_and_preempt#why")
def stops_in_any_phase_of_the_gait(run: Transcript) -> None:
    """Wherever its feet are when the cancel comes, the robot stops upright"""
    for delay in run.params["delays"]:
        request = run.goal(f"after {delay:g} s").require_canceled()
        require_walking(run, request.t)
        require_stopped(run, request.t)


@check(points=1, on=NEAR_ARRIVAL, needs=stops_when_canceled, see="07_cancel_and_preempt#fix-read")
def cancels_near_arrival(run: Transcript) -> None:
    """A cancel just before arrival ends CANCELED, or SUCCEEDED at the goal, with the robot still"""
    goal = require_accepted(run.goal("near"))
    cancel = run.goal("near").requests_to_cancel[-1]
    distance, _turn = error(run.robot_at(cancel.sent.t), goal)
    expect(
        distance <= run.params["distance"] + NEAR,
        expected="the robot near its goal after 15 s, where it is cancelled",
        observed=f"it is {distance:.2f} m away",
        help="Walk at 0.3 m/s or so: 0.7 m take a few seconds.",
        at=cancel.sent.t,
    )
    if goal.status == SUCCEEDED:
        require_arrival(goal)
    else:
        cancel.require_agreed(goal)
        goal.require_result(CANCELED)
    require_stopped(run, cancel.sent.t)


@check(points=1, on=AFTER_THE_END, needs=arrives, see="07_cancel_and_preempt#late-why")
def survives_a_cancel_after_the_end(run: Transcript) -> None:
    """A cancel after the result changes nothing, and the next goal is walked to"""
    require_arrival(run.goal("first"))
    cancel = run.goal("first").requests_to_cancel[0]
    result = run.goal("first").result
    if result is None or result.t > cancel.sent.t:
        raise unseen(run, "the cancel did not come after the end")
    require_alive(run)
    expect(
        cancel.answer is not None and not cancel.answer.canceling,
        expected="the cancel of a goal that has ended to be refused",
        observed="no answer" if cancel.answer is None else "the server agreed to cancel it",
        help="Keep no list of goals of your own: rclpy knows which goals are active and refuses the others.",
        at=cancel.sent.t,
    )
    require_arrival(run.goal("second"))


@check(points=1, on=TWICE, needs=cancels_in_mid_stride, see="07_cancel_and_preempt#m12-why")
def survives_two_cancels(run: Transcript) -> None:
    """The same cancel asked for twice ends CANCELED once, and both are answered"""
    goal, cancels = run.goal("walk"), run.goal("walk").requests_to_cancel
    goal.require_canceled(cancels[0])
    require_alive(run)
    if len(cancels) < 2:
        raise unseen(run, "the cancel was asked for only once")
    require_walking(run, cancels[0].sent.t)
    expect(
        all(cancel.answer is not None for cancel in cancels),
        expected="an answer to both cancel requests",
        observed="one was not answered within 5 s",
        help="cancel_callback may be called again for the same goal: return CancelResponse.ACCEPT and change "
        "nothing else in it.",
        at=cancels[-1].sent.t,
    )
    goal.require_silence_afterwards()


@check(points=1, on=BY_A_STRANGER, needs=stops_when_canceled, see="07_cancel_and_preempt#conventions")
def obeys_a_stranger(run: Transcript) -> None:
    """Another client may cancel every goal"""
    request = run.goal("walk").require_canceled(run.cancels_of_all[-1])
    require_walking(run, request.t)
    require_stopped(run, request.t)


@check(points=1, on=OTHER_NAMESPACE, needs=arrives, see="01_robot_and_graph#names-why")
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it walks the robot there"""
    require_arrival(run.goal("walk"))
