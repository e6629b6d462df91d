"""A scripted `walk_to`, with feedback and results of a robot that might be on its way, and what befalls its clients."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.arena.client_stage import ClientStage
from autograder.arena.poses import pose_at
from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from humanoid_interfaces.action import WalkTo

ARGUMENTS = ("1.0", "0.5", "0.3")  # x m, y m, yaw rad
ARRIVED = (1.0, 0.5, 0.3)  # m, m, rad
ON_THE_WAY = (0.4, 0.1, 0.2)  # m, m, rad
UNDER_WAY = 3  # feedback messages
SOON = 15.0  # s for a goal to come


def offer(stage: ClientStage, **script: object) -> ScriptedAction:
    """Offer `walk_to`; `script` are the fields of a GoalScript, by which every goal is treated."""
    return stage.offer_action("walk_to", WalkTo, GoalScript(**script))  # type: ignore[arg-type]


def run(stage: ClientStage, arguments: Sequence[str] = ARGUMENTS) -> None:
    """Run the student's program to its end."""
    stage.start_program(arguments)
    stage.wait_for_end()


def is_under_way(stage: ClientStage, walk_to: ScriptedAction) -> bool:
    """Wait until there was some feedback, and return whether there was."""
    stage.wait_until(lambda: walk_to.feedbacks >= UNDER_WAY or stage.has_ended(), SOON)
    return walk_to.feedbacks >= UNDER_WAY


def interrupt(
    stage: ClientStage, *, ends_after: float | None = None, arrives_after: float | None = None
) -> None:
    """Press Ctrl-C while the robot walks; the server agrees to the cancel.

    The goal is CANCELED `ends_after` s later, or it has SUCCEEDED `arrives_after` s after its acceptance; None: never.
    """
    cancel = CancelScript(ends_after=ends_after, result=result_at(ON_THE_WAY))
    walk_to = offer(
        stage, feedback=way(500), ends_after=arrives_after, result=result_at(ARRIVED), cancel=cancel
    )
    stage.start_program(ARGUMENTS)
    if is_under_way(stage, walk_to):
        stage.interrupt_program()
    stage.wait_for_end()


def die(stage: ClientStage) -> None:
    """Let the server die while the robot walks."""
    walk_to = offer(stage, feedback=way(500), ends_after=None)
    stage.start_program(ARGUMENTS)
    if is_under_way(stage, walk_to):
        walk_to.withdraw()
    stage.wait_for_end()


def send_early_feedback(stage: ClientStage, distance: float) -> None:
    """Send feedback of this distance (m) a second before the goal is accepted."""
    offer(
        stage,
        early_feedback=[feedback(distance)],
        after=1.0,
        feedback=way(5),
        ends_after=1.0,
        result=result_at(ARRIVED),
    )
    run(stage)


def way(messages: int) -> list[WalkTo.Feedback]:
    """Return the feedback of a robot that comes nearer and never arrives."""
    return [feedback(1.1 * 0.9**number) for number in range(messages)]


def feedback(distance: float) -> WalkTo.Feedback:
    """Return the feedback of a robot so far (m) from its goal."""
    message = WalkTo.Feedback(distance_remaining=distance)
    message.current_pose.header.frame_id = "odom"
    message.current_pose.pose.orientation.w = 1.0
    return message


def result_at(final: Sequence[float]) -> WalkTo.Result:
    """Return the result of a walk that ended at a pose (m, m, rad)."""
    x, y, yaw = final
    return WalkTo.Result(final_pose=pose_at(x, y, yaw), total_steps=9)
