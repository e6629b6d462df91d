"""Action servers for a walk client to deal with. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Sequence

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped

from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from humanoid_interfaces.action import WalkTo

ARGUMENTS = ("1.0", "0.5", "0.3")  # x m, y m, yaw rad
UNDER_WAY = 3  # feedback messages
SOON = 15.0  # s for a goal to come
FELL = WalkTo.Result.FELL


def good(
    stage: ClientStage, arguments: Sequence[str], distances: Sequence[float], final: Sequence[float]
) -> None:
    """The goal is accepted, followed by feedback of these distances (m), and ends at `final` (m, m, rad)."""
    feedback = [_feedback(distance) for distance in distances]
    _offer(stage, feedback=feedback, ends_after=0.2 * len(distances) + 0.2, result=_result(final))
    _run(stage, arguments)


def without_node(stage: ClientStage, arguments: Sequence[str]) -> None:
    """The server is there, and the program is started with these arguments."""
    _offer(stage)
    _run(stage, arguments)


def nobody(stage: ClientStage) -> None:
    """There is no server."""
    _run(stage)


def rejecting(stage: ClientStage) -> None:
    """The goal is rejected."""
    _offer(stage, accepted=False)
    _run(stage)


def unanswered(stage: ClientStage) -> None:
    """The goal is never answered."""
    _offer(stage, accepted=None)
    _run(stage)


def aborting(stage: ClientStage, error_code: int, error_msg: str) -> None:
    """The goal is aborted on the way, with this code and message."""
    result = WalkTo.Result(error_code=error_code, error_msg=error_msg)
    _offer(stage, feedback=_way(5), ends_after=1.0, status=GoalStatus.STATUS_ABORTED, result=result)
    _run(stage)


def succeeding_with_words(stage: ClientStage, final: Sequence[float]) -> None:
    """The goal succeeds, and a message for people comes with it."""
    result = _result(final)
    result.error_msg = "the floor is slippery"
    _offer(stage, feedback=_way(5), ends_after=1.0, result=result)
    _run(stage)


def canceled_by_another(stage: ClientStage) -> None:
    """Somebody else cancels the goal."""
    _offer(
        stage,
        feedback=_way(5),
        ends_after=1.0,
        status=GoalStatus.STATUS_CANCELED,
        result=_result((0.4, 0.1, 0.2)),
    )
    _run(stage)


def silent(stage: ClientStage) -> None:
    """The goal is accepted, and then nothing is heard any more."""
    _offer(stage, ends_after=None)
    _run(stage)


def falling_silent(stage: ClientStage) -> None:
    """There is feedback for a while, and then nothing is heard any more; a cancel stays unanswered, too."""
    _offer(stage, feedback=_way(5), ends_after=None, cancel=CancelScript(agreed=None))
    _run(stage)


def slow_but_lively(stage: ClientStage, every: float, times: int) -> None:
    """The walk takes long, and feedback comes only each `every` s, so many times."""
    _offer(
        stage, feedback=_way(times), every=every, ends_after=every * times, result=_result((1.0, 0.5, 0.3))
    )
    _run(stage)


def dying(stage: ClientStage) -> None:
    """The server dies while the robot walks."""
    walk_to = _offer(stage, feedback=_way(500), ends_after=None)
    stage.start_program(ARGUMENTS)
    if _is_under_way(stage, walk_to):
        walk_to.withdraw()
    stage.wait_for_end()


def early_feedback(stage: ClientStage, distance: float) -> None:
    """Feedback comes before the goal is accepted, and the acceptance takes a second."""
    _offer(
        stage,
        early_feedback=[_feedback(distance)],
        after=1.0,
        feedback=_way(5),
        ends_after=1.0,
        result=_result((1.0, 0.5, 0.3)),
    )
    _run(stage)


def interrupted(stage: ClientStage, ends_after: float | None) -> None:
    """Ctrl-C while the robot walks; the cancel is agreed to, and the goal ends so much later (s), or never."""
    cancel = CancelScript(ends_after=ends_after, result=_result((0.4, 0.1, 0.2)))
    walk_to = _offer(stage, feedback=_way(500), ends_after=None, cancel=cancel)
    stage.start_program(ARGUMENTS)
    if _is_under_way(stage, walk_to):
        stage.interrupt_program()
    stage.wait_for_end()


def _offer(stage: ClientStage, **script: object) -> ScriptedAction:
    return stage.offer_action("walk_to", WalkTo, GoalScript(**script))  # type: ignore[arg-type]


def _run(stage: ClientStage, arguments: Sequence[str] = ARGUMENTS) -> None:
    stage.start_program(arguments)
    stage.wait_for_end()


def _is_under_way(stage: ClientStage, walk_to: ScriptedAction) -> bool:
    stage.wait_until(lambda: walk_to.feedbacks >= UNDER_WAY or stage.has_ended(), SOON)
    return walk_to.feedbacks >= UNDER_WAY


def _way(messages: int) -> list[WalkTo.Feedback]:
    """Feedback of a robot that comes nearer and never arrives."""
    return [_feedback(1.1 * 0.9**number) for number in range(messages)]


def _feedback(distance: float) -> WalkTo.Feedback:
    feedback = WalkTo.Feedback(distance_remaining=distance)
    feedback.current_pose.header.frame_id = "odom"
    feedback.current_pose.pose.orientation.w = 1.0
    return feedback


def _result(final: Sequence[float]) -> WalkTo.Result:
    x, y, yaw = final
    pose = PoseStamped()
    pose.header.frame_id = "odom"
    pose.pose.position.x, pose.pose.position.y = x, y
    pose.pose.orientation.z, pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return WalkTo.Result(final_pose=pose, total_steps=9)
