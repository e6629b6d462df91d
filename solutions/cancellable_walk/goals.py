"""What the server answers to goals and cancels, and how goals end."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.checks import Failure, expect
from autograder.authoring.server_checks import require_alive
from autograder.authoring.transcript import CancelHistory, GoalHistory, Transcript

STATUS = {1: "ACCEPTED", 2: "EXECUTING", 3: "CANCELING", 4: "SUCCEEDED", 5: "CANCELED", 6: "ABORTED"}
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
FELL, PREEMPTED = 1, 2


def require_accepted(run: Transcript, name: str) -> GoalHistory:
    """The server answered the goal with yes."""
    goal = run.goal(name)
    if goal.answer is None:
        require_alive(run)
        raise Failure(
            expected="the goal to be accepted",
            observed=_no_answer(run, goal),
            help="The executor was busy: on one thread a callback that sleeps or waits keeps goals and cancels "
            "from being served. "
            "Use MultiThreadedExecutor, or an async execute callback that awaits.",
            at=goal.sent.t,
        )
    expect(
        goal.answer.accepted,
        expected="the goal to be accepted",
        observed="it was rejected",
        help="goal_callback must return GoalResponse.ACCEPT for a finite pose in frame odom while the motors "
        "are on (True is not "
        "GoalResponse.ACCEPT).",
        at=goal.answer.t,
    )
    return goal


def require_rejected(run: Transcript, name: str, why: str, help: str) -> None:
    """The server answered the goal with no."""
    goal = run.goal(name)
    if goal.answer is None:
        require_alive(run)
    expect(
        goal.answer is not None and not goal.answer.accepted,
        expected=f"the goal to be rejected: {why}",
        observed="it was accepted" if goal.answer else _no_answer(run, goal),
        help=help,
        at=goal.answer.t if goal.answer else goal.sent.t,
    )


def _no_answer(run: Transcript, goal: GoalHistory) -> str:
    given_up = next(
        (event for event in run.all(ev.Unanswered) if (event.what, event.id) == ("goal", goal.name)), None
    )
    return f"no answer to the goal within {given_up.waited if given_up else run.end - goal.sent.t:.0f} s"


def require_result(run: Transcript, goal: GoalHistory, status: int) -> ev.ResultReceived:
    """The goal ended with the given status."""
    if goal.result is None:
        require_alive(run)
        raise Failure(
            expected=f"a result with status {STATUS[status]}",
            observed="no result",
            help="Every path through execute must make one terminal call (succeed, canceled or abort) and "
            "return a Result. succeed() "
            "followed by `return None` never reaches the client.",
            at=run.end,
        )
    expect(
        goal.result.status == status,
        expected=f"status {STATUS[status]}",
        observed=f"status {STATUS.get(goal.result.status, goal.result.status)}",
        help=_status_advice(goal.result.status, status),
        at=goal.result.t,
    )
    return goal.result


def _status_advice(observed: int, wanted: int) -> str:
    if observed == ABORTED and wanted == SUCCEEDED:
        return (
            "ABORTED is also what rclpy reports when execute raises or makes no terminal call: call "
            "goal_handle.succeed()."
        )
    if observed == ABORTED and wanted == CANCELED:
        return (
            "Once is_cancel_requested is seen, stop the robot, call goal_handle.canceled() and return; an "
            "exception or a missing terminal call gives ABORTED."
        )
    if observed == SUCCEEDED and wanted == CANCELED:
        return (
            "An accepted cancel ends with goal_handle.canceled(), not succeed(): look at is_cancel_requested "
            "in every round."
        )
    if wanted == ABORTED:
        return (
            "Call goal_handle.abort(), with the reason in result.error_code, when the goal cannot be reached "
            "any more."
        )
    return "Look at which terminal call (succeed, canceled, abort) execute makes on this path."


def require_cancel_accepted(run: Transcript, cancel: CancelHistory, goal: GoalHistory) -> None:
    """The server agreed to cancel the goal."""
    if cancel.answer is None:
        require_alive(run)
        raise Failure(
            expected="an answer to the cancel request",
            observed="none within 5 s",
            help="While execute sleeps on the only thread, nobody serves the cancel request: use "
            "MultiThreadedExecutor, or an async "
            "execute callback that awaits instead of time.sleep.",
            at=cancel.sent.t,
        )
    if goal.name in cancel.answer.canceling:
        return
    ended = cancel.answer.return_code == 3
    raise Failure(
        expected="the server to agree to cancel",
        observed="it answered only when the goal had ended (return code 3)"
        if ended
        else "it refused (no goal in goals_canceling)",
        help="While execute sleeps on the only thread, nobody serves the cancel request in time: use "
        "MultiThreadedExecutor, or await."
        if ended
        else "rclpy refuses every cancel by default: give ActionServer a cancel_callback that returns "
        "CancelResponse.ACCEPT.",
        at=cancel.answer.t,
    )


def require_canceled(run: Transcript, goal_name: str, *, by_request_for_all: bool = False) -> ev.CancelSent:
    """The goal was accepted, the cancel agreed to, the goal ended CANCELED; returns the request."""
    goal = require_accepted(run, goal_name)
    request = run.cancels_of("" if by_request_for_all else goal_name)[
        -1
    ]  # earlier ones may have overtaken their goal
    require_cancel_accepted(run, request, goal)
    require_result(run, goal, CANCELED)
    return request.sent


def require_error_code(result: ev.ResultReceived, code: int, name: str) -> None:
    """The result names the reason."""
    observed = result.result["error_code"]
    expect(
        observed == code,
        expected=f"error_code {code} ({name})",
        observed=f"error_code {observed}",
        help=f"Set result.error_code = WalkTo.Result.{name} before the terminal call, and return that same "
        "result.",
        at=result.t,
    )
