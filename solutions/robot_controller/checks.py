"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring.checks import check, program
from autograder.authoring.client_checks import require_offered
from autograder.authoring.transcript import Transcript

from .advice import ENABLE, STATUS
from .judging import (
    require_enabled_before_asked,
    require_failure,
    require_late_servers,
    require_one_deadline,
    require_pause_of_two_seconds,
    require_printed_second_answer,
    require_printed_status,
    require_silence,
)

GOOD = program("good", {"status": "Motors: ON"})
NOBODY = program("nobody")
SILENT_ENABLE = program("silent_enable")
FIRST_LOST = program("first_lost", {"status": "Motors: ON"})

LATE_AND_SILENT = program("late_and_silent", {"appears": 1.6, "answers": 1.7})


@check(points=2, on=GOOD, see="03_clients_that_survive#fix-frame")
def enables_then_asks(run: Transcript) -> None:
    """It enables the motors, and asks for the status once that is answered"""
    require_enabled_before_asked(run)


@check(points=2, on=GOOD, needs=enables_then_asks, see="03_clients_that_survive#fix-frame")
def prints_the_status(run: Transcript) -> None:
    """It prints “Robot status: ” with the message of the answer, and ends with status 0"""
    require_printed_status(run, [run.params["status"]])


@check(points=2, on=NOBODY, needs=prints_the_status, see="03_clients_that_survive#fix-why")
def gives_up_without_servers(run: Transcript) -> None:
    """Without any server it ends with status 1 within 10 s, and says so on stderr"""
    for service in (ENABLE, STATUS):
        require_offered(run, service, servers=0)
    require_failure(run, "nobody offers enable_motors and get_status")


@check(points=2, on=SILENT_ENABLE, needs=prints_the_status, see="03_clients_that_survive#fix-why")
def asks_once_more(run: Transcript) -> None:
    """Without an answer it asks once more after 2 s, then gives up with status 1"""
    require_pause_of_two_seconds(*require_silence(run, ENABLE))
    require_failure(run, "enable_motors has not answered")


@check(points=1, on=FIRST_LOST, needs=prints_the_status, see="03_clients_that_survive#fix-why")
def makes_use_of_the_second_answer(run: Transcript) -> None:
    """When the first request of a service is lost, the second one counts"""
    require_printed_second_answer(run)


@check(
    points=1,
    on=LATE_AND_SILENT,
    needs=[gives_up_without_servers, asks_once_more],
    see="03_clients_that_survive#fix-module",
)
def keeps_one_deadline(run: Transcript) -> None:
    """It gives up within 10 s in all, also when servers come late and answer late"""
    require_late_servers(run, run.params["appears"])
    require_failure(run, "get_status has not answered")
    require_one_deadline(run)
