"""Action servers for a walk client to deal with. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence

from action_msgs.msg import GoalStatus

from autograder.arena import scripted_walk
from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_action import CancelScript
from autograder.arena.scripted_walk import feedback, offer, result_at, run, way
from humanoid_interfaces.action import WalkTo


def good(
    stage: ClientStage, arguments: Sequence[str], distances: Sequence[float], final: Sequence[float]
) -> None:
    """The goal is accepted, followed by feedback of these distances (m), and ends at `final` (m, m, rad)."""
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


def rejecting(stage: ClientStage) -> None:
    """The goal is rejected."""
    offer(stage, accepted=False)
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


def succeeding_with_words(stage: ClientStage, final: Sequence[float]) -> None:
    """The goal succeeds, and a message for people comes with it."""
    result = result_at(final)
    result.error_msg = "the floor is slippery"
    offer(stage, feedback=way(5), ends_after=1.0, result=result)
    run(stage)


def canceled_by_another(stage: ClientStage) -> None:
    """Somebody else cancels the goal."""
    offer(
        stage,
        feedback=way(5),
        ends_after=1.0,
        status=GoalStatus.STATUS_CANCELED,
        result=result_at((0.4, 0.1, 0.2)),
    )
    run(stage)


def forgetful(stage: ClientStage, kept_for: float, final: Sequence[float]) -> None:
    """The goal succeeds, and the server keeps its result only so long (s)."""
    offer(stage, feedback=way(5), ends_after=1.0, kept_for=kept_for, result=result_at(final))
    run(stage)


def silent(stage: ClientStage) -> None:
    """The goal is accepted, and then nothing is heard any more."""
    offer(stage, ends_after=None)
    run(stage)


def falling_silent(stage: ClientStage) -> None:
    """There is feedback for a while, and then nothing is heard any more; a cancel stays unanswered, too."""
    offer(stage, feedback=way(5), ends_after=None, cancel=CancelScript(agreed=None))
    run(stage)


def slow_but_lively(stage: ClientStage, every: float, times: int) -> None:
    """The walk takes long, and feedback comes only each `every` s, so many times."""
    offer(
        stage, feedback=way(times), every=every, ends_after=every * times, result=result_at((1.0, 0.5, 0.3))
    )
    run(stage)


def dying(stage: ClientStage) -> None:
    """The server dies while the robot walks."""
    scripted_walk.die(stage)


def early_feedback(stage: ClientStage, distance: float) -> None:
    """Feedback comes before the goal is accepted, and the acceptance takes a second."""
    scripted_walk.send_early_feedback(stage, distance)


def interrupted(stage: ClientStage, ends_after: float | None, arrives_after: float | None = None) -> None:
    """Ctrl-C while the robot walks; the goal is CANCELED so much later (s), or the robot arrives all the same."""
    scripted_walk.interrupt(stage, ends_after=ends_after, arrives_after=arrives_after)
