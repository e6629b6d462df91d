"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from random import Random
from typing import Any

from autograder.authoring import check_of, program

from . import checks, model
from .checks import ENABLED, FAILS, ON, WHY, replies

Script = dict[str, Any]
SUCCEEDS = (model.ends_as_it_went, model.tells_one_status)
ASKS = (model.enables_then_asks, model.repeats_enable_once)
ENABLED_SLOWLY = [True, "the motors are on", 1.0]
TOO_LATE, JUST_IN_TIME = [True, "Motors: OFF", 2.6], [True, "Motors: ON", 1.2]


def _message(random: Random) -> str:
    return f"Motors: ON, {random.uniform(20, 60):.1f} degC, {random.randrange(10_000)} steps"


def _delay(random: Random) -> float:
    return round(random.uniform(0.0, 1.3), 2)


def _enabled(random: Random) -> list[Any]:
    return [True, "the motors are on", _delay(random)]


def _any_status(random: Random) -> Script:
    """Draw servers that respond in time or to the second request, with any status and either value of success."""
    yes: Any = _enabled(random)
    status = [random.choice([True, False]), f"  {_message(random)}", _delay(random)]
    return replies(random.choice([[yes], [None, yes]]), [status])


def _refusal(random: Random) -> Script:
    """Draw an enable_motors that responds with success false and an empty message."""
    no: Any = [False, "", _delay(random)]
    return replies(random.choice([[no], [no, ENABLED], [None, no]]), [ON])


def _any_servers(random: Random) -> dict[str, Script]:
    """Draw each service: responses in time, late or missing; servers that die, come back, or share a name."""
    yes = _enabled(random)
    message = random.choice([_message(random), "Robot status: twice", "x" * 200, "  two spaces  in  it"])
    told = [random.choice([True, False]), message, _delay(random)]
    dies: Script = {"replies": [None], "dies_after": 1}
    enables: list[Script] = [
        *({"replies": [yes]}, {"replies": [None, yes]}, {"replies": [yes], "servers": 2}),
        *({**dies, "returns": 0.4, "then": [yes]}, dies),
    ]
    statuses: list[Script] = [
        *({"replies": each} for each in ([None, told], [told], [[True, "too late", 2.6], told], [None])),
        *({**dies, "returns": 0.4, "then": [None, told]}, {**dies, "dies_after": 2}),
    ]
    return {"enable": random.choice(enables), "status": random.choice(statuses)}


def _status(**script: Any) -> Any:
    """Return the scenario in which enable_motors responds at once, and get_status follows the script."""
    return program("servers", replies([ENABLED], None) | {"status": script})


ANY_STATUS = program("servers", _any_status)
OTHER_NAMESPACE = program(
    "servers", lambda random: replies([ENABLED], [[True, _message(random), 0.0]]), namespace="/lab_7/robot"
)
ONE_OF_TWO = program("servers", replies([ENABLED], None))
ANOTHER_TYPE = _status(type="SetBool", replies=[ON])
SILENT_STATUS = program(
    "servers", lambda random: replies(random.choice([[ENABLED], [None, _enabled(random)]]), [None])
)
SLOW = program("servers", lambda random: replies([ENABLED_SLOWLY], [[True, _message(random), 1.0]]))
LATE = _status(replies=[TOO_LATE, JUST_IN_TIME])
DYING = _status(replies=[None], dies_after=1)
RESTARTING = _status(replies=[None], dies_after=1, returns=0.4, then=[ON])
TWO = _status(replies=[ON], servers=2)
REFUSING = program("servers", _refusal)
ANY_SERVERS = program("servers", _any_servers)

prints_any_status = check_of(
    [model.ends_as_it_went, model.prints_the_status],
    title="It prints every status unchanged, also one with success false",
    on=ANY_STATUS,
    needs=checks.prints_the_status,
    see="03_clients_that_survive#fix-file",
)

works_in_any_namespace = check_of(
    [model.asks_here, *SUCCEEDS],
    title="Started in another namespace, it calls the robot's services there",
    on=OTHER_NAMESPACE,
    needs=checks.enables_then_asks,
)

needs_both_services = check_of(
    [*FAILS, model.looks_for_two_seconds],
    title="If get_status is missing or has another type, it exits with status 1 after 2 s",
    on=[ONE_OF_TWO, ANOTHER_TYPE],
    needs=checks.gives_up_without_servers,
    see="03_clients_that_survive#fix-run",
)

gives_up_on_a_silent_status = check_of(
    [*ASKS, model.repeats_status_once, *FAILS],
    title="It also retries get_status once, then gives up, however long enable_motors took",
    on=SILENT_STATUS,
    needs=checks.asks_once_more,
    see="03_clients_that_survive#fix-module",
)

waits_for_slow_answers = check_of(
    [*ASKS, model.repeats_status_once, *SUCCEEDS],
    title="It waits for responses that take 1 s",
    on=SLOW,
    needs=checks.enables_then_asks,
    see=WHY,
)

is_not_confused_by_a_late_answer = check_of(
    [model.repeats_status_once, *SUCCEEDS],
    title="A late response that comes while it waits for the second one does no harm",
    on=LATE,
    needs=checks.makes_use_of_the_second_answer,
)

survives_a_dying_server = check_of(
    FAILS,
    title="If a server dies during a request, it exits with status 1",
    on=DYING,
    needs=checks.asks_once_more,
    see="03_clients_that_survive#kill-why",
)

finds_a_restarted_server = check_of(
    model.holds_whatever_servers_do,
    title="It retries when a server dies and comes back; every clause holds, whatever the servers do",
    on=[RESTARTING, ANY_SERVERS],
    needs=checks.makes_use_of_the_second_answer,
)

copes_with_two_servers = check_of(
    [*ASKS, *SUCCEEDS],
    title="With two servers of the same name it prints one status",
    on=TWO,
    needs=checks.enables_then_asks,
    see="03b_clients_in_bad_company#two-why",
)

reports_a_refusal = check_of(
    [model.switches_on, model.repeats_enable_once, *FAILS],
    title="After success false of enable_motors it sends no more requests, and exits with status 1",
    on=REFUSING,
    needs=checks.enables_then_asks,
)
