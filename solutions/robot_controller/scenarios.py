"""Servers for a robot controller to deal with. No expected answers here: this runs in the arena."""

from __future__ import annotations

from std_srvs.srv import SetBool, Trigger

from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_service import SILENCE, Reply, ScriptedService

FIRST_REQUEST_TIMEOUT = 15.0  # s
END_OF_A_CALL = 5.0  # s from the first request, for a second one
RESTART = 0.4  # s; a client may ask again 2 s after its first request


def _enabled(after: float = 0.0) -> Reply:
    return Reply(SetBool.Response(success=True, message="the motors are on"), after)


def _status(message: str, after: float = 0.0) -> Reply:
    return Reply(Trigger.Response(success=True, message=message), after)


def _offer_enable(stage: ClientStage, *replies: Reply | None) -> ScriptedService:
    return stage.offer_service("enable_motors", SetBool, *(replies or [_enabled()]))


def _offer_status(stage: ClientStage, *replies: Reply | None) -> ScriptedService:
    return stage.offer_service("get_status", Trigger, *replies)


def _run(stage: ClientStage) -> None:
    stage.start_program()
    stage.wait_for_end()


def good(stage: ClientStage, status: str) -> None:
    """Both servers answer soon; enable_motors takes long enough to see whether it is waited for."""
    _offer_enable(stage, _enabled(after=0.3))
    _offer_status(stage, _status(status))
    _run(stage)


def nobody(stage: ClientStage) -> None:
    """There is no server at all."""
    _run(stage)


def one_of_two(stage: ClientStage) -> None:
    """Only enable_motors is there."""
    _offer_enable(stage)
    _run(stage)


def another_type(stage: ClientStage) -> None:
    """get_status is there with another type."""
    _offer_enable(stage)
    stage.offer_service("get_status", SetBool, Reply())
    _run(stage)


def silent_enable(stage: ClientStage) -> None:
    """enable_motors takes every request and answers none."""
    _offer_enable(stage, SILENCE)
    _offer_status(stage, _status("Motors: OFF"))
    _run(stage)


def silent_status(stage: ClientStage) -> None:
    """get_status takes every request and answers none."""
    _offer_enable(stage)
    _offer_status(stage, SILENCE)
    _run(stage)


def first_lost(stage: ClientStage, status: str) -> None:
    """Each server leaves its first request unanswered and answers the second."""
    _offer_enable(stage, SILENCE, _enabled())
    _offer_status(stage, SILENCE, _status(status))
    _run(stage)


def slow(stage: ClientStage, status: str, after: float) -> None:
    """Each answer takes `after` s."""
    _offer_enable(stage, _enabled(after))
    _offer_status(stage, _status(status, after))
    _run(stage)


def late(stage: ClientStage, statuses: tuple[str, str], after: tuple[float, float]) -> None:
    """The answer to the first get_status comes `after[0]` s later, when the second request waits for its own."""
    _offer_enable(stage)
    _offer_status(stage, *(_status(status, delay) for status, delay in zip(statuses, after, strict=True)))
    _run(stage)


def dying(stage: ClientStage) -> None:
    """get_status dies while it works on the first request."""
    _offer_enable(stage)
    status = _offer_status(stage, SILENCE)
    stage.start_program()
    if stage.wait_for_requests(status, 1, FIRST_REQUEST_TIMEOUT):
        status.withdraw()
    stage.wait_for_end()


def restarting(stage: ClientStage, status: str) -> None:
    """get_status dies while it works on the first request and is soon started again."""
    _offer_enable(stage)
    first = _offer_status(stage, SILENCE)
    stage.start_program()
    if stage.wait_for_requests(first, 1, FIRST_REQUEST_TIMEOUT):
        first.withdraw()
        stage.wait(RESTART)
        _offer_status(stage, _status(status))
    stage.wait_for_end()


def two_of_one_name(stage: ClientStage, status: str) -> None:
    """Two servers offer get_status, and both answer."""
    _offer_enable(stage)
    _offer_status(stage, _status(status))
    _offer_status(stage, _status(status))
    _run(stage)


def late_and_silent(stage: ClientStage, appears: float, answers: float) -> None:
    """Each server appears `appears` s after the client could look for it; enable_motors is slow, get_status silent.

    enable_motors answers the second request, `answers` s after it. A client that waits for both servers before it asks
    gets get_status that long after enable_motors, any other that long after the answer of enable_motors.
    """
    stage.start_program()
    stage.wait(appears)
    enable = _offer_enable(stage, SILENCE, _enabled(after=answers))
    if stage.wait_for_requests(enable, 1, appears) and stage.wait_for_requests(enable, 2, END_OF_A_CALL):
        stage.wait(answers + appears)
    _offer_status(stage, SILENCE)
    stage.wait_for_end()


def refusing(stage: ClientStage, reason: str) -> None:
    """enable_motors says no."""
    _offer_enable(stage, Reply(SetBool.Response(success=False, message=reason)))
    _offer_status(stage, _status("Motors: OFF"))
    _run(stage)
