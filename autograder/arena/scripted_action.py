"""A scripted action, good or faulty, that a student's client has to deal with.

It is offered by its five endpoints and not by rclpy's ActionServer, which never publishes feedback before the
acceptance, never leaves a goal or a cancel unanswered, and always sends a result.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import repeat
from typing import Any

from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from builtin_interfaces.msg import Time
from rclpy.node import Node
from rclpy.qos import qos_profile_action_status_default
from rclpy.task import Future
from unique_identifier_msgs.msg import UUID

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.bounded_reading import BoundedReading
from autograder.arena.scripting import offer, pause, type_name

EVERY_GOAL = bytes(16)  # the id in a request to cancel all of them
DEPTH = 10  # of the feedback publisher's queue, as in rclpy's ActionServer


@dataclass(frozen=True)
class CancelScript:
    """How requests to cancel a goal are treated; times are s on the arena's clock.

    Attributes:
        agreed: whether the server agrees; None: it never answers.
        refusal: the return_code of action_msgs/CancelGoal when it does not agree.
        after: from the request to the answer.
        ends_after: from the answer to the end with status CANCELED; None: the goal goes on to its own end.
        result: the action's Result of a canceled goal; None: an empty one.
    """

    agreed: bool | None = True
    refusal: int = CancelGoal.Response.ERROR_NONE
    after: float = 0.0
    ends_after: float | None = 0.5
    result: Any = None


@dataclass(frozen=True)
class GoalScript:
    """How a goal is treated; times are s on the arena's clock.

    Attributes:
        accepted: whether it is accepted; None: the server never answers.
        after: from the goal's request to the answer.
        early_feedback: published before the answer.
        feedback: published one by one from the acceptance on, as long as the goal is active.
        every: interval between two of them, s; a sequence: one interval after each.
        ends_after: from the acceptance to the end; None: it never ends by itself.
        status: how it ends, of action_msgs/GoalStatus.
        result: the action's Result; None: an empty one.
        result_after: from the goal's end to the answer to a request for its result; None: there is no answer.
        kept_for: from the goal's end until the server drops goal and result (rclpy's result_timeout); a later request
            gets status UNKNOWN. None: it never drops them.
        cancel: how requests to cancel the goal are treated.
    """

    accepted: bool | None = True
    after: float = 0.0
    early_feedback: Sequence[Any] = ()
    feedback: Sequence[Any] = ()
    every: float | Sequence[float] = 0.2
    ends_after: float | None = 0.0
    status: int = GoalStatus.STATUS_SUCCEEDED
    result: Any = None
    result_after: float | None = 0.0
    kept_for: float | None = None
    cancel: CancelScript = field(default_factory=CancelScript)


class _Goal:
    """A goal that was accepted."""

    def __init__(self, name: str, goal_id: UUID, script: GoalScript) -> None:
        self.name = name
        self.script = script
        self.info = GoalInfo(goal_id=goal_id, stamp=_now())
        self.status = GoalStatus.STATUS_EXECUTING
        self.result: Any = None
        self.finished: Future = Future()


class ScriptedAction:
    """Offers one action. The first goal is treated by the first of `scripts`, and so on; the last one is repeated.

    `server` names it in the transcript, since two servers may offer the same action. `number` returns the name of the
    next "goal" or "cancel", such as "goal 2".

    Attributes:
        name: of the action.
        feedbacks: the number of feedback messages it has published.
        answers: the number of goals it has accepted or rejected.
    """

    def __init__(
        self,
        node: Node,
        action_type: Any,
        name: str,
        scripts: Sequence[GoalScript],
        server: str,
        log: ArenaLog,
        number: Callable[[str], str],
    ) -> None:
        self.name = name
        self._node = node
        self._type = action_type
        self._scripts = scripts
        self._server = server
        self._log = log
        self._number = number
        self._reading = BoundedReading(log)
        self._names: dict[bytes, str] = {}
        self._goals: dict[bytes, _Goal] = {}
        self._withdrawn = False
        self.feedbacks = 0
        self.answers = 0
        types = action_type.Impl
        self._services = [
            offer(node, types.SendGoalService, f"{name}/_action/send_goal", self._on_goal),
            offer(node, types.GetResultService, f"{name}/_action/get_result", self._on_result_request),
            offer(node, CancelGoal, f"{name}/_action/cancel_goal", self._on_cancel),
        ]
        self._feedback = node.create_publisher(types.FeedbackMessage, f"{name}/_action/feedback", DEPTH)
        self._statuses = node.create_publisher(
            GoalStatusArray, f"{name}/_action/status", qos_profile_action_status_default
        )
        log.append(ev.ActionOffered(action=name, server=server, type=type_name(action_type)))

    @property
    def goals(self) -> int:
        """The number of goals it has been sent."""
        return self._log.count(ev.GoalReceived, action=self.name, server=self._server)

    @property
    def cancels(self) -> int:
        """The number of requests to cancel that it has had."""
        return self._log.count(ev.CancelReceived, action=self.name, server=self._server)

    def withdraw(self) -> None:
        """Destroy the action with its goals, as if its process had died."""
        self._log.append(ev.ActionWithdrawn(action=self.name, server=self._server))
        self._withdrawn = True
        for service in self._services:
            self._node.destroy_service(service)
        for publisher in (self._feedback, self._statuses):
            self._node.destroy_publisher(publisher)

    # -- requests of the client ---------------------------------------------------------------------------------------

    async def _on_goal(self, request: Any, response: Any) -> Any:
        goal_id = bytes(request.goal_id.uuid)
        if goal_id in self._names or not self._log.admits(ev.GoalReceived.kind, self.name):
            return response  # the same goal again, or a flood
        name = self._names[goal_id] = self._number("goal")
        script = self._scripts[min(self.goals, len(self._scripts) - 1)]
        too_large = self._reading.is_too_large("request", name, request)
        message = self._type.Goal() if too_large else request.goal
        self._log.append(ev.GoalReceived(goal=name, action=self.name, server=self._server, message=message))
        if script.accepted is None:
            await Future()  # never completed: no answer is sent
        for feedback in script.early_feedback:
            self._publish_feedback(name, request.goal_id, feedback)
        await pause(self._node, script.after)
        response.accepted, response.stamp = bool(script.accepted), _now()
        self.answers += 1
        self._log.append(ev.GoalReplySent(goal=name, accepted=response.accepted))
        if script.accepted and not self._withdrawn:
            goal = self._goals[goal_id] = _Goal(name, request.goal_id, script)
            self._publish_statuses()
            for task in (self._send_feedback, self._come_to_an_end):
                self._start_task(task, goal)
        return response

    async def _on_result_request(self, request: Any, response: Any) -> Any:
        goal_id = bytes(request.goal_id.uuid)
        name, goal = self._names.get(goal_id), self._goals.get(goal_id)
        if name is None or not self._log.admits(ev.ResultRequested.kind, name):
            return response  # its status is UNKNOWN, as rclpy answers
        self._log.append(ev.ResultRequested(goal=name))
        if goal is None:
            return response
        await goal.finished
        delay = goal.script.result_after
        if delay is None:
            return await Future()  # never completed: no answer is sent
        await pause(self._node, delay)
        response.status, response.result = goal.status, goal.result
        self._log.append(ev.ResultSent(goal=goal.name))
        return response

    async def _on_cancel(self, request: Any, response: Any) -> Any:
        asked = bytes(request.goal_info.goal_id.uuid)
        if not self._log.admits(ev.CancelReceived.kind, self.name):
            return response
        name = self._number("cancel")
        of = "" if asked == EVERY_GOAL else self._names.get(asked, f"unknown {asked.hex()[:8]}")
        self._log.append(ev.CancelReceived(cancel=name, action=self.name, server=self._server, goal=of))
        meant = self._goals.values() if asked == EVERY_GOAL else filter(None, [self._goals.get(asked)])
        goals = list(meant)
        active = [goal for goal in goals if not goal.finished.done()]
        if not active:
            codes = CancelGoal.Response
            over = codes.ERROR_GOAL_TERMINATED if goals else codes.ERROR_UNKNOWN_GOAL_ID
            response.return_code = codes.ERROR_NONE if asked == EVERY_GOAL else over
        elif await self._refuses(active[0].script.cancel):
            response.return_code = active[0].script.cancel.refusal
        else:
            for goal in active:
                self._begin_to_cancel(goal)
            response.goals_canceling = [goal.info for goal in active]
        canceling = [goal.name for goal in active] if response.goals_canceling else []
        self._log.append(
            ev.CancelReplySent(cancel=name, return_code=response.return_code, canceling=canceling)
        )
        return response

    # -- execution of a goal ------------------------------------------------------------------------------------------

    async def _send_feedback(self, goal: _Goal) -> None:
        every = goal.script.every
        gaps = repeat(every) if isinstance(every, float) else every
        for feedback, gap in zip(goal.script.feedback, gaps, strict=False):
            if goal.finished.done() or self._withdrawn:
                return
            self._publish_feedback(goal.name, goal.info.goal_id, feedback)
            await pause(self._node, gap)

    async def _come_to_an_end(self, goal: _Goal) -> None:
        if goal.script.ends_after is not None:
            await pause(self._node, goal.script.ends_after)
            self._finish(goal, goal.script.status, goal.script.result)

    async def _refuses(self, script: CancelScript) -> bool:
        if script.agreed is None:
            await Future()  # never completed: no answer is sent
        await pause(self._node, script.after)
        return not script.agreed

    def _begin_to_cancel(self, goal: _Goal) -> None:
        if goal.finished.done():
            return
        goal.status = GoalStatus.STATUS_CANCELING
        self._publish_statuses()

        async def end(goal: _Goal) -> None:
            script = goal.script.cancel
            if script.ends_after is not None:
                await pause(self._node, script.ends_after)
                self._finish(goal, GoalStatus.STATUS_CANCELED, script.result)

        self._start_task(end, goal)

    def _finish(self, goal: _Goal, status: int, result: Any) -> None:
        if goal.finished.done() or self._withdrawn:
            return
        goal.status, goal.result = status, self._type.Result() if result is None else result
        self._log.append(ev.GoalFinished(goal=goal.name, status=status, result=goal.result))
        self._publish_statuses()
        goal.finished.set_result(None)
        if goal.script.kept_for is not None:
            self._start_task(self._forget, goal)

    async def _forget(self, goal: _Goal) -> None:
        await pause(self._node, goal.script.kept_for or 0.0)
        if not self._withdrawn:
            del self._goals[bytes(goal.info.goal_id.uuid)]
            self._log.append(ev.ResultForgotten(goal=goal.name))
            self._publish_statuses()

    def _start_task(self, task: Callable[[_Goal], Any], goal: _Goal) -> None:
        executor = self._node.executor
        assert executor is not None  # an executor spins the grader's node during the whole scenario
        executor.create_task(task, goal)

    def _publish_feedback(self, name: str, goal_id: UUID, feedback: Any) -> None:
        self.feedbacks += 1
        self._feedback.publish(self._type.Impl.FeedbackMessage(goal_id=goal_id, feedback=feedback))
        self._log.append(ev.FeedbackSent(goal=name, feedback=feedback))

    def _publish_statuses(self) -> None:
        statuses = [GoalStatus(goal_info=goal.info, status=goal.status) for goal in self._goals.values()]
        self._statuses.publish(GoalStatusArray(status_list=statuses))


def _now() -> Time:
    seconds, nanoseconds = divmod(time.time_ns(), 10**9)
    return Time(sec=seconds, nanosec=nanoseconds)
