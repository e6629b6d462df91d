"""One goal as its client saw it, and what every exercise may require of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from action_msgs.srv import CancelGoal

from autograder.authoring.diagnosis.goal_diagnosis import (
    STARVED_LESSON,
    final_status,
    lesson_on_the_end,
    went_on,
    why_it_ended_so,
    why_no_result,
    why_starved,
)
from autograder.authoring.diagnosis.missing import Missing
from autograder.authoring.diagnosis.readiness import require_alive
from autograder.authoring.diagnosis.stack_location import where_it_waited
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.fields import expect_field
from autograder.authoring.evidence.robot_record import RobotRecord
from autograder.authoring.failure import Failure, expect
from ros_runtime.message_constants import GoalStatus, name_of

SUCCEEDED, CANCELED, ABORTED = GoalStatus.SUCCEEDED, GoalStatus.CANCELED, GoalStatus.ABORTED

_BUSY = (
    "The executor was busy: with one thread, a callback that sleeps or waits blocks the callbacks for goals and "
    "cancels. Use MultiThreadedExecutor, or an async execute callback that awaits."
)
_ACCEPT = (
    "goal_callback must return GoalResponse.ACCEPT for a goal that can be carried out (True is not "
    "GoalResponse.ACCEPT)."
)
_SLEEPS = (
    "While execute sleeps on the only thread, the cancel request is not answered{in_time}: use MultiThreadedExecutor, "
    "or an async execute callback that awaits instead of time.sleep."
)
_REFUSES = (
    "rclpy refuses every cancel by default: give ActionServer a cancel_callback that returns "
    "CancelResponse.ACCEPT."
)


@dataclass(frozen=True)
class Cancel:
    """One cancel request and its answer (None: never answered)."""

    sent: ev.CancelSent
    answer: ev.CancelAnswered | None
    run: RobotRecord = field(repr=False)

    def require_agreed(self, goal: Goal) -> None:
        """Require that the server accepted the request to cancel the goal."""
        if self.answer is None:
            require_alive(self.run)
            raise Failure(
                expected="an answer to the cancel request",
                observed="none within 5 s",
                help=_SLEEPS.format(in_time=""),
                at=self.sent.t,
            )
        if goal.name in self.answer.canceling:
            return
        if goal.result and goal.result.t <= self.sent.t:
            raise Failure(
                expected="a goal that is still active when the cancel comes",
                observed=f"it had ended {name_of(GoalStatus, goal.result.status)} at {goal.result.t:.1f} s",
                help=why_it_ended_so(goal, CANCELED),
                at=goal.result.t,
                see=lesson_on_the_end(goal),
            )
        has_ended = self.answer.return_code == CancelGoal.Response.ERROR_GOAL_TERMINATED
        raise Failure(
            expected="the server to accept the cancel request",
            observed="it answered only when the goal had ended (return code 3)"
            if has_ended
            else "it refused (no goal in goals_canceling)",
            help=_SLEEPS.format(in_time=" in time") if has_ended else _REFUSES,
            at=self.answer.t,
        )


@dataclass(frozen=True)
class Goal:
    """One goal. If there is no answer or result, requirements on it fail with the reason."""

    name: str
    sent: ev.GoalSent
    answer: ev.GoalAnswered | None
    feedback: Sequence[ev.FeedbackReceived]
    statuses: Sequence[ev.StatusSeen]
    cancels: Sequence[Cancel]
    result: ev.ResultReceived | None
    run: RobotRecord = field(repr=False)

    @property
    def request(self) -> Any:
        """The goal itself, a ROS message."""
        return self.sent.request

    @property
    def status(self) -> int | None:
        """The final status (action_msgs/GoalStatus), None without a result."""
        return self.result.status if self.result else None

    @property
    def requests_to_cancel(self) -> Sequence[Cancel]:
        """The requests to cancel it, of which there must be at least one."""
        if not self.cancels:
            raise Missing(
                self.run,
                expected=f"a server that gets as far as the request to cancel the goal “{self.name}”",
                never=f"a cancel of the goal “{self.name}” was never requested",
            )
        return self.cancels

    @property
    def accepted_at(self) -> float:
        """When (s) the client received the acceptance; requires that the goal was accepted."""
        self.require_accepted()
        assert self.answer
        return self.answer.t

    def require_accepted(self, help: str = _ACCEPT) -> Goal:
        """Require that the server accepted it."""
        if self.answer is None:
            require_alive(self.run)
            place = where_it_waited(self.run)
            raise Failure(
                expected="the goal to be accepted",
                observed=self._no_answer(),
                help=f"It was blocked in {place}. {_BUSY}" if place else _BUSY,
                at=self.sent.t,
            )
        expect(
            self.answer.accepted,
            expected="the goal to be accepted",
            observed="it was rejected",
            help=help,
            at=self.answer.t,
        )
        return self

    def require_rejected(self, *, because: str, help: str) -> None:
        """Require that the server rejected it."""
        if self.answer is None:
            require_alive(
                self.run, "A goal_callback that raises ends the node: return GoalResponse.REJECT instead."
            )
        expect(
            self.answer is not None and not self.answer.accepted,
            expected=f"the goal to be rejected: {because}",
            observed="it was accepted" if self.answer else self._no_answer(),
            help=help,
            at=self.answer.t if self.answer else self.sent.t,
        )

    def require_result(self, status: int, help: str | None = None) -> ev.ResultReceived:
        """Require that it ended with a status (SUCCEEDED, CANCELED, ABORTED), and return the result.

        Args:
            status: the final status.
            help: what to do if the goal went on, or succeeded, instead of ending with this status.
        """
        if self.result is None:
            require_alive(self.run)
        last = self.result or final_status(self)
        if last is None or (self.result is None and last.status == status):
            observed, advice = why_no_result(self)
            raise Failure(
                expected=f"a result with status {name_of(GoalStatus, status)}",
                observed=observed,
                help=help if help and went_on(self) and not why_starved(self) else advice,
                at=self.run.end,
                see=STARVED_LESSON if why_starved(self) else "",
            )
        ended = last.status
        expect(
            ended == status,
            expected=f"status {name_of(GoalStatus, status)}",
            observed=f"status {name_of(GoalStatus, ended)}",
            help=help if help and ended == SUCCEEDED else why_it_ended_so(self, status),
            at=last.t,
            see=lesson_on_the_end(self),
        )
        assert self.result
        return self.result

    def require_canceled(self, request: Cancel | None = None) -> None:
        """Require that it was accepted, that its (last) cancel request was accepted, and that it ended CANCELED."""
        self.require_accepted()
        request = request or self.requests_to_cancel[-1]  # earlier ones may have arrived before the goal
        request.require_agreed(self)
        self.require_result(CANCELED)

    def require_reason(self) -> None:
        """Require that its result has an error_msg that is not empty; the result must have come."""
        assert self.result, "call require_result first"
        expect(
            bool(self.result.result.error_msg.strip()),
            expected="error_msg to say why the goal was ABORTED",
            observed="it is empty",
            help="Set result.error_msg to a sentence for people before the terminal call.",
            at=self.result.t,
        )

    def expect(self, path: str, value: Any, *, because: str, help: str, see: str = "") -> None:
        """Require that a field of its result, which must be there, has a value."""
        assert self.result, "call require_result first"
        expect_field(self.result.result, path, value, because=because, help=help, at=self.result.t, see=see)

    def _no_answer(self) -> str:
        given_up = self.run.given_up("goal", self.name)
        return f"no answer to the goal within {given_up.waited if given_up else self.run.end - self.sent.t:.0f} s"
