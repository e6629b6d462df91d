"""Action servers, and lines typed on stdin. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence

from action_msgs.msg import GoalStatus

from autograder.arena import scripted_walk
from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_action import CancelScript
from autograder.arena.scripted_walk import (
    ARGUMENTS,
    ON_THE_WAY,
    feedback,
    is_under_way,
    offer,
    result_at,
    run,
    way,
)
from humanoid_interfaces.action import WalkTo

ARRIVED = (0.97, 0.52, 0.31)  # m, m, rad
SOON = 15.0  # s for a goal to come
BETWEEN = 0.5  # s between two lines typed


# -- nothing is typed -------------------------------------------------------------------------------------------------


def good(
    stage: ClientStage, arguments: Sequence[str], distances: Sequence[float], final: Sequence[float]
) -> None:
    """The goal is followed by feedback of these distances (m), and ends at `final` (m, m, rad); nobody types."""
    messages = [feedback(distance) for distance in distances]
    offer(stage, feedback=messages, ends_after=0.2 * len(distances) + 0.2, result=result_at(final))
    run(stage, arguments)


def without_node(stage: ClientStage, arguments: Sequence[str]) -> None:
    """The server is there, and the program is started with these arguments."""
    offer(stage)
    run(stage, arguments)


def nobody(stage: ClientStage) -> None:
    """There is no server."""
    run(stage)


def unanswered(stage: ClientStage) -> None:
    """The goal is never answered."""
    offer(stage, accepted=None)
    run(stage)


def aborting(stage: ClientStage, error_code: int, error_msg: str) -> None:
    """The goal is aborted on the way, with this code and message."""
    result = WalkTo.Result(error_code=error_code, error_msg=error_msg)
    offer(stage, feedback=way(5), ends_after=1.0, status=GoalStatus.STATUS_ABORTED, result=result)
    run(stage)


def silent(stage: ClientStage) -> None:
    """The goal is accepted, and then nothing is heard any more."""
    offer(stage, ends_after=None)
    run(stage)


def falling_silent(stage: ClientStage) -> None:
    """There is feedback for a while, and then nothing is heard any more; a cancel stays unanswered, too."""
    offer(stage, feedback=way(5), ends_after=None, cancel=CancelScript(agreed=None))
    run(stage)


def dying(stage: ClientStage) -> None:
    """The server dies while the robot walks."""
    scripted_walk.die(stage)


def early_feedback(stage: ClientStage, distance: float) -> None:
    """Feedback comes before the goal is accepted, and the acceptance takes a second."""
    scripted_walk.send_early_feedback(stage, distance)


def interrupted(stage: ClientStage, ends_after: float) -> None:
    """Ctrl-C while the robot walks; the cancel is agreed to, and the goal ends so much later (s)."""
    scripted_walk.interrupt(stage, ends_after=ends_after)


# -- something is typed -----------------------------------------------------------------------------------------------


def typed(stage: ClientStage, lines: Sequence[str], ends_after: float) -> None:
    """Lines are typed while the robot walks; a cancel is agreed to, and the goal ends so much later (s).

    Without a cancel the robot arrives.
    """
    cancel = CancelScript(ends_after=ends_after, result=result_at(ON_THE_WAY))
    _type_on_the_way(
        stage, lines, feedback=way(500), ends_after=6.0, result=result_at(ARRIVED), cancel=cancel
    )


def agreed_and_over(stage: ClientStage, status: int, error_msg: str) -> None:
    """A `q` is agreed to, but the goal ends in another way, with this status and message."""
    result = result_at(ARRIVED)
    result.error_msg = error_msg
    _type_on_the_way(
        stage,
        ["q"],
        feedback=way(500),
        ends_after=3.0,
        status=status,
        result=result,
        cancel=CancelScript(ends_after=None),
    )


def refusing(stage: ClientStage) -> None:
    """A `q` is refused, after half a second, and the robot arrives."""
    _type_on_the_way(
        stage,
        ["q"],
        feedback=way(500),
        ends_after=4.0,
        result=result_at(ARRIVED),
        cancel=CancelScript(agreed=False, after=0.5),
    )


def too_late(stage: ClientStage) -> None:
    """A `q` comes when the goal has ended and its result is still on its way."""
    walk_to = offer(stage, feedback=way(3), ends_after=1.0, result=result_at(ARRIVED), result_after=2.5)
    stage.start_program(ARGUMENTS)
    if is_under_way(stage, walk_to):
        stage.wait(1.5)
        stage.type_line("q")
    stage.wait_for_end()


def deaf_to_cancels(stage: ClientStage) -> None:
    """A `q` gets no answer, and the robot arrives."""
    _type_on_the_way(
        stage,
        ["q"],
        feedback=way(500),
        ends_after=8.0,
        result=result_at(ARRIVED),
        cancel=CancelScript(agreed=None),
    )


def typed_early(stage: ClientStage, accepted: bool) -> None:
    """A `q` is typed when the goal has been sent, two seconds before it is accepted or rejected."""
    cancel = CancelScript(result=result_at(ON_THE_WAY))
    walk_to = offer(
        stage,
        accepted=accepted,
        after=2.0,
        feedback=way(500),
        ends_after=6.0,
        result=result_at(ARRIVED),
        cancel=cancel,
    )
    stage.start_program(ARGUMENTS)
    if stage.wait_until(lambda: walk_to.goals or stage.has_ended(), SOON) and walk_to.goals:
        stage.type_line("q")
    stage.wait_for_end()


def end_of_input(stage: ClientStage, at_once: bool) -> None:
    """The input ends, before the goal is accepted or while the robot walks, and the robot arrives."""
    walk_to = offer(stage, after=1.5, feedback=way(500), ends_after=3.0, result=result_at(ARRIVED))
    stage.start_program(ARGUMENTS)
    if at_once or is_under_way(stage, walk_to):
        stage.end_input()
    stage.wait_for_end()


def _type_on_the_way(stage: ClientStage, lines: Sequence[str], **script: object) -> None:
    walk_to = offer(stage, **script)
    stage.start_program(ARGUMENTS)
    if is_under_way(stage, walk_to):
        for line in lines:
            stage.type_line(line)
            stage.wait(BETWEEN)
    stage.wait_for_end()
