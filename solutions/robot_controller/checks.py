"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring.checks import program
from autograder.authoring.obligation import check_of

from . import model

ENABLED = [True, "the motors are on", 0.0]
ON = [True, "Motors: ON", 0.0]
GOOD = program(
    "servers", {"enable": {"replies": [[True, "the motors are on", 0.3]]}, "status": {"replies": [ON]}}
)
NOBODY = program("servers")
SILENT_ENABLE = program("servers", {"enable": {"replies": [None]}, "status": {"replies": [ON]}})
FIRST_LOST = program(
    "servers",
    {"enable": {"replies": [None, ENABLED]}, "status": {"replies": [None, [False, "Motors: OFF", 0.0]]}},
)
LATE_AND_SILENT = program("late_and_silent", {"appears": 1.6, "answers": 1.7})


enables_then_asks = check_of(
    "enables_then_asks",
    model.enables_then_asks,
    title="It enables the motors, and asks for the status once that is answered",
    points=2,
    on=GOOD,
    see="03_clients_that_survive#fix-frame",
)

prints_the_status = check_of(
    "prints_the_status",
    model.ends_as_it_went,
    model.prints_the_status,
    model.keeps_one_deadline,
    title="It prints “Robot status: ” with the message of the answer, and ends with status 0",
    points=2,
    on=GOOD,
    needs=enables_then_asks,
    see="03_clients_that_survive#fix-frame",
)

gives_up_without_servers = check_of(
    "gives_up_without_servers",
    model.ends_as_it_went,
    model.says_why_it_fails,
    model.keeps_one_deadline,
    title="Without any server it ends with status 1 within 10 s, and says so on stderr",
    points=2,
    on=NOBODY,
    needs=enables_then_asks,
    see="03_clients_that_survive#fix-why",
)

asks_once_more = check_of(
    "asks_once_more",
    model.repeats_enable_once,
    model.ends_as_it_went,
    model.says_why_it_fails,
    model.switches_on,
    title="Without an answer it asks once more after 2 s, then gives up with status 1",
    points=2,
    on=SILENT_ENABLE,
    needs=enables_then_asks,
    see="03_clients_that_survive#fix-why",
)

makes_use_of_the_second_answer = check_of(
    "makes_use_of_the_second_answer",
    model.repeats_enable_once,
    model.repeats_status_once,
    model.ends_as_it_went,
    model.tells_one_status,
    model.enables_then_asks,
    title="When the first request of a service is lost, the second one counts",
    points=1,
    on=FIRST_LOST,
    needs=enables_then_asks,
    see="03_clients_that_survive#fix-why",
)

keeps_one_deadline = check_of(
    "keeps_one_deadline",
    model.repeats_enable_once,
    model.ends_as_it_went,
    model.says_why_it_fails,
    model.keeps_one_deadline,
    title="It gives up within 10 s in all, also when servers come late and answer late",
    points=1,
    on=LATE_AND_SILENT,
    needs=[gives_up_without_servers, asks_once_more],
    see="03_clients_that_survive#fix-module",
)
