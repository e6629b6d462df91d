"""Scenarios for clients of `walk_to`: a scripted server and a simulated user at the keyboard, both given as data."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from autograder.arena.client_stage import ClientStage
from autograder.arena.poses import pose_at
from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.units import Seconds
from humanoid_interfaces.action import WalkTo

ON_THE_WAY = (0.4, 0.1, 0.2)  # m, m, rad
GOAL_TIMEOUT = 15.0  # s for a goal, or a cancel, to come

# How a server treats a goal: the fields of a GoalScript, with these differences:
#   distances, early: distance_remaining (m) of each message, in the place of feedback and early_feedback
#   error_code, error_msg, and for `walk_to` final (x, y, yaw): of the result
#   cancel: the fields of a CancelScript
Server = Mapping[str, Any]


def in_order(stage: ClientStage, arguments: Sequence[str], server: Server | None, steps: Steps) -> None:
    """Offer `walk_to` as `server` describes (None: not at all), run the program with the steps, wait for its end."""
    script = None if server is None else _walk_script(**server)
    World(stage, "walk_to", WalkTo, script).play(arguments, steps)


class World:
    """The environment of a client: a server, and a user who types and presses Ctrl-C until the program has ended."""

    def __init__(self, stage: ClientStage, name: str, action: Any, script: GoalScript | None) -> None:
        self._stage, self._name, self._action, self._script = stage, name, action, script
        self._server: ScriptedAction | None = None

    def play(self, arguments: Sequence[str], steps: Steps, **verbs: Callable[..., object]) -> None:
        """Run the program, carry out the steps, and wait for its end; `verbs` are further kinds of steps.

        A server with a script is offered from the start, or by the step "offer" if there is one.
        """
        stage = self._stage
        if self._script and ["offer"] not in steps:
            self._offer()
        stage.start_program(arguments)
        vocabulary: dict[str, Callable[..., object]] = {
            "offer": self._offer,
            "await_goal": lambda: self._await("goals"),
            "await_answer": lambda: self._await("answers"),
            "await_cancel": lambda: self._await("cancels"),
            "wait": self._wait,
            "type": lambda line: self._do(stage.type_line, line),
            "end_input": lambda: self._do(stage.end_input),
            "press_ctrl_c": lambda: self._do(stage.interrupt_program),
            "end_server": lambda: self._do(self._server.withdraw) if self._server else None,
        }
        carry_out(stage, steps, {**vocabulary, **verbs})
        stage.wait_for_end()

    def _offer(self) -> None:
        assert self._script is not None
        self._server = self._stage.offer_action(self._name, self._action, self._script)

    def _await(self, what: str) -> bool:
        """Wait until the server has counted one of `what`: "goals", "answers" or "cancels"; return whether it has."""

        def has_come() -> int:
            return getattr(self._server, what)

        self._stage.wait_until(lambda: has_come() or self._stage.has_ended(), GOAL_TIMEOUT)
        return has_come() > 0

    def _wait(self, duration: Seconds) -> None:
        self._stage.wait_until(self._stage.has_ended, duration)

    def _do(self, act: Callable[..., object], *arguments: Any) -> None:
        if not self._stage.has_ended():
            act(*arguments)


def feedback(action: Any, distance: float, **fields: Any) -> Any:
    """Return the feedback of a robot `distance` m away from its goal."""
    message = action.Feedback(distance_remaining=distance, **fields)
    message.current_pose.header.frame_id = "odom"
    message.current_pose.pose.orientation.w = 1.0
    return message


def _walk_script(
    distances: Sequence[float] = (),
    early: Sequence[float] = (),
    final: Sequence[float] = (0.97, 0.52, 0.31),
    error_code: int = 0,
    error_msg: str = "",
    cancel: Mapping[str, Any] | None = None,
    **others: Any,
) -> GoalScript:
    return GoalScript(
        feedback=[feedback(WalkTo, distance) for distance in distances],
        early_feedback=[feedback(WalkTo, distance) for distance in early],
        result=_result(final, error_code=error_code, error_msg=error_msg),
        cancel=CancelScript(result=_result(ON_THE_WAY), **(cancel or {})),
        **others,
    )


def _result(final: Sequence[float], **error: Any) -> WalkTo.Result:
    x, y, yaw = final
    return WalkTo.Result(final_pose=pose_at(x, y, yaw), total_steps=9, **error)
