"""A scripted `walk_to`, and a person at its client's keyboard: what they do is data, which the checks write or draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from autograder.arena.client_stage import ClientStage
from autograder.arena.poses import pose_at
from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from autograder.arena.sequence import Steps, carry_out
from humanoid_interfaces.action import WalkTo

ARRIVED = (0.97, 0.52, 0.31)  # m, m, rad
ON_THE_WAY = (0.4, 0.1, 0.2)  # m, m, rad
SOON = 15.0  # s for a goal to come

# What a server does: the fields of a GoalScript, but for
#   distances, early: of the feedback (m), instead of feedback and early_feedback
#   final, error_code, error_msg: of the result
#   cancel: the fields of a CancelScript
Server = Mapping[str, Any]


def in_order(stage: ClientStage, arguments: Sequence[str], server: Server | None, steps: Steps) -> None:
    """Offer `walk_to` as the script says, run the program, carry out the steps, await its end.

    The server is there from the start, or from a step on that says so; None: there is none.
    """
    world = _World(stage, server)
    if server is not None and ["offer"] not in steps:
        world.offer()
    stage.start_program(arguments)
    carry_out(stage, steps, world.vocabulary())
    stage.wait_for_end()


class _World:
    """The server, and a person who waits, types and presses Ctrl-C; a program that has ended is left alone."""

    def __init__(self, stage: ClientStage, server: Server | None) -> None:
        self._stage, self._server = stage, server
        self._walk_to: ScriptedAction | None = None

    def vocabulary(self) -> dict[str, Any]:
        return {
            "offer": self.offer,
            "await_goal": lambda: self._await("goals"),
            "await_answer": lambda: self._await("answers"),
            "wait": lambda duration: self._stage.wait_until(self._stage.has_ended, duration) or None,
            "type": lambda line: self._do(self._stage.type_line, line),
            "end_input": lambda: self._do(self._stage.end_input),
            "press_ctrl_c": lambda: self._do(self._stage.interrupt_program),
            "end_server": lambda: self._do(self._walk_to.withdraw) if self._walk_to else None,
        }

    def offer(self) -> None:
        self._walk_to = self._stage.offer_action("walk_to", WalkTo, _goal_script(**(self._server or {})))

    def _await(self, what: str) -> bool:
        """Wait until the server has got a goal, or answered one; return whether it has."""

        def has_come() -> int:
            return getattr(self._walk_to, what)

        self._stage.wait_until(lambda: has_come() or self._stage.has_ended(), SOON)
        return has_come() > 0

    def _do(self, act: Any, *arguments: Any) -> None:
        if not self._stage.has_ended():
            act(*arguments)


def _goal_script(
    distances: Sequence[float] = (),
    early: Sequence[float] = (),
    final: Sequence[float] = ARRIVED,
    error_code: int = 0,
    error_msg: str = "",
    cancel: Mapping[str, Any] | None = None,
    **others: Any,
) -> GoalScript:
    return GoalScript(
        feedback=[_feedback(distance) for distance in distances],
        early_feedback=[_feedback(distance) for distance in early],
        result=_result(final, error_code, error_msg),
        cancel=CancelScript(result=_result(ON_THE_WAY), **(cancel or {})),
        **others,
    )


def _feedback(distance: float) -> WalkTo.Feedback:
    message = WalkTo.Feedback(distance_remaining=distance)
    message.current_pose.header.frame_id = "odom"
    message.current_pose.pose.orientation.w = 1.0
    return message


def _result(final: Sequence[float], error_code: int = 0, error_msg: str = "") -> WalkTo.Result:
    x, y, yaw = final
    return WalkTo.Result(
        final_pose=pose_at(x, y, yaw), total_steps=9, error_code=error_code, error_msg=error_msg
    )
