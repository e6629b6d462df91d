"""The checks that students can see and run themselves."""

from __future__ import annotations

from autograder.authoring import check_of, program

from . import model

Reply = list[object]  # success, message, s until it is sent
ENABLED: Reply = [True, "the motors are on", 0.0]
ON: Reply = [True, "Motors: ON", 0.0]
EMPTY: Reply = [False, "", 0.0]
ENABLED_TOO_LATE: Reply = [True, "the motors are on", 2.6]
REFUSED: Reply = [False, "the emergency stop is pressed", 0.0]


def replies(enable: list[Reply | None] | None, status: list[Reply | None] | None) -> dict[str, object]:
    """Return the servers' scripts: the replies of each in order, None for no reply; a script of None: no server."""
    scripts = {"enable": enable, "status": status}
    return {name: {"replies": each} for name, each in scripts.items() if each is not None}


GOOD = program("servers", replies([[True, "the motors are on", 0.3]], [ON]))
NOBODY = program("servers")
SILENT_ENABLE = program("servers", replies([None], [ON]))
FIRST_LOST = program("servers", replies([ENABLED_TOO_LATE, ENABLED], [None, EMPTY]))
LATE_AND_SILENT = program("late_and_silent", {"appears": 1.6, "answers": 1.7})
REFUSING_ONCE = program("servers", replies([REFUSED, ENABLED], [ON]))

WHY = "03_clients_that_survive#fix-why"
FAILS = (model.ends_as_it_went, model.says_why_it_fails, model.keeps_one_deadline)


enables_then_asks = check_of(model.enables_then_asks, points=2, on=GOOD)

prints_the_status = check_of(
    [model.ends_as_it_went, model.prints_the_status, model.keeps_one_deadline],
    title="It prints “Robot status: ” with the message of the response, and exits with status 0",
    points=2,
    on=GOOD,
    needs=enables_then_asks,
)

gives_up_without_servers = check_of(
    [*FAILS, model.looks_for_two_seconds],
    title="Without any server it waits 2 s for one, exits with status 1 within 10 s, and says so on stderr",
    points=2,
    on=NOBODY,
    needs=enables_then_asks,
    see=WHY,
)

asks_once_more = check_of(
    [model.repeats_enable_once, model.ends_as_it_went, model.says_why_it_fails, model.switches_on],
    title="Without a response it retries once after 2 s, then exits with status 1",
    points=2,
    on=SILENT_ENABLE,
    needs=enables_then_asks,
)

makes_use_of_the_second_answer = check_of(
    [
        model.repeats_enable_once,
        model.repeats_status_once,
        model.ends_as_it_went,
        model.tells_one_status,
        model.enables_then_asks,
    ],
    title="If the response to the first request is missing or late, it uses the second; an empty message also counts",
    on=FIRST_LOST,
    needs=enables_then_asks,
)

keeps_one_deadline = check_of(
    [model.repeats_enable_once, *FAILS],
    title="It gives up within 10 s in total, also if servers appear and respond late, and at once after success false",
    on=[LATE_AND_SILENT, REFUSING_ONCE],
    needs=[gives_up_without_servers, asks_once_more],
    see="03_clients_that_survive#fix-module",
)
