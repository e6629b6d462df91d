"""What only the instructor's grading checks."""

from __future__ import annotations

from random import Random
from typing import Any

from autograder.authoring.checks import program
from autograder.authoring.obligation import check_of

from . import model
from .checks import (
    ENABLED,
    ON,
    asks_once_more,
    enables_then_asks,
    gives_up_without_servers,
    makes_use_of_the_second_answer,
    prints_the_status,
)

Script = dict[str, Any]
ENABLES: Script = {"replies": [ENABLED]}
SUCCEEDS = (model.ends_as_it_went, model.tells_one_status)
FAILS = (model.ends_as_it_went, model.says_why_it_fails, model.keeps_one_deadline)
ASKS = (model.enables_then_asks, model.repeats_enable_once)


def _message(random: Random) -> str:
    return f"Motors: ON, {random.uniform(20, 60):.1f} degC, {random.randrange(10_000)} steps"


def _delay(random: Random) -> float:
    return round(random.uniform(0.0, 1.3), 2)


def _any_status(random: Random) -> dict[str, Script]:
    return {"enable": ENABLES, "status": {"replies": [[True, _message(random), 0.0]]}}


def _empty_status(random: Random) -> dict[str, Script]:
    """Answer in time, or to the second request; the status is empty: it is an answer, whatever its success is."""
    late = [True, "the motors are on", _delay(random)]
    return {
        "enable": {"replies": random.choice([[late], [None, late]])},
        "status": {"replies": [[random.choice([True, False]), "", _delay(random)]]},
    }


def _refusal(random: Random) -> dict[str, Script]:
    no = [False, "the emergency stop is pressed", _delay(random)]
    return {
        "enable": {"replies": random.choice([[no], [no, ENABLED], [None, no]])},
        "status": {"replies": [ON]},
    }


def _silent_status(random: Random) -> dict[str, Script]:
    """get_status is silent; enable_motors may have needed its second request, too."""
    replies = random.choice([[ENABLED], [None, [True, "the motors are on", _delay(random)]]])
    return {"enable": {"replies": replies}, "status": {"replies": [None]}}


def _any_servers(random: Random) -> dict[str, Script]:
    """Draw what each service does: in time, late, lost, silent, gone, back, missing, refusing, two of a name."""
    yes = [True, "the motors are on", _delay(random)]
    enables: list[Script] = [
        {"replies": [yes]},
        {"replies": [None, yes]},
        {"replies": [yes], "servers": 2},
        {"replies": [None], "dies_after": 1, "returns": 0.4, "then": [yes]},
        {"replies": [None], "dies_after": 1},
    ]
    message = random.choice([_message(random), "Robot status: twice", "x" * 200, "  two spaces  in  it"])
    told = [random.choice([True, False]), message, _delay(random)]
    statuses: list[Script] = [
        {"replies": [None, told]},
        {"replies": [told]},
        {"replies": [[True, "too late", 2.6], told]},
        {"replies": [None]},
        {"replies": [None], "dies_after": 1, "returns": 0.4, "then": [None, told]},
        {"replies": [None], "dies_after": 2},
    ]
    return {"enable": random.choice(enables), "status": random.choice(statuses)}


ANY_STATUS = program("servers", _any_status)
OTHER_NAMESPACE = program("servers", _any_status, namespace="/lab_7/robot")
ONE_OF_TWO = program("servers", {"enable": ENABLES})
ANOTHER_TYPE = program("servers", {"enable": ENABLES, "status": {"type": "SetBool", "replies": [ON]}})
SILENT_STATUS = program("servers", _silent_status)
SLOW = program(
    "servers",
    lambda random: {
        "enable": {"replies": [[True, "the motors are on", 1.0]]},
        "status": {"replies": [[True, _message(random), 1.0]]},
    },
)
EMPTY = program("servers", _empty_status)
LATE = program(
    "servers",
    {
        "enable": ENABLES,
        "status": {"replies": [[True, "Motors: OFF", 2.6], [True, "Motors: ON", 1.2]]},
    },
)
LATE_ENABLE = program(
    "servers",
    {
        "enable": {"replies": [[True, "the motors are on", 2.6], ENABLED]},
        "status": {"replies": [[True, "Motors: ON", 1.2]]},
    },
)
DYING = program("servers", {"enable": ENABLES, "status": {"replies": [None], "dies_after": 1}})
RESTARTING = program(
    "servers",
    lambda random: {
        "enable": ENABLES,
        "status": {
            "replies": [None],
            "dies_after": 1,
            "returns": 0.4,
            "then": [[True, _message(random), 0.0]],
        },
    },
)
TWO = program(
    "servers",
    lambda random: {"enable": ENABLES, "status": {"replies": [[True, _message(random), 0.0]], "servers": 2}},
)
REFUSING = program("servers", _refusal)
ANY_SERVERS = program("servers", _any_servers)

prints_any_status = check_of(
    "prints_any_status",
    model.ends_as_it_went,
    model.prints_the_status,
    title="Whatever the status says, it is printed as it came, also an empty one and one with success: false",
    points=1,
    on=[ANY_STATUS, EMPTY],
    needs=prints_the_status,
    see="03_clients_that_survive#fix-file",
)

works_in_any_namespace = check_of(
    "works_in_any_namespace",
    model.asks_here,
    model.ends_as_it_went,
    model.tells_one_status,
    title="Started in another namespace, it asks the robot there",
    points=1,
    on=OTHER_NAMESPACE,
    needs=enables_then_asks,
    see="01_robot_and_graph#names-why",
)

needs_both_services = check_of(
    "needs_both_services",
    *FAILS,
    title="A get_status that is missing, or of another type, ends it with status 1",
    points=1,
    on=[ONE_OF_TWO, ANOTHER_TYPE],
    needs=gives_up_without_servers,
    see="03_clients_that_survive#fix-run",
)

gives_up_on_a_silent_status = check_of(
    "gives_up_on_a_silent_status",
    *ASKS,
    model.repeats_status_once,
    *FAILS,
    title="get_status is also asked twice and then given up, whatever enable_motors needed",
    points=1,
    on=SILENT_STATUS,
    needs=asks_once_more,
    see="03_clients_that_survive#fix-module",
)

waits_for_slow_answers = check_of(
    "waits_for_slow_answers",
    *ASKS,
    model.repeats_status_once,
    *SUCCEEDS,
    title="Answers that take 1 s are waited for",
    points=1,
    on=SLOW,
    needs=enables_then_asks,
    see="03_clients_that_survive#fix-why",
)

is_not_confused_by_a_late_answer = check_of(
    "is_not_confused_by_a_late_answer",
    model.repeats_status_once,
    *SUCCEEDS,
    title="An answer that comes after its time, while another is waited for, does no harm",
    points=1,
    on=[LATE, LATE_ENABLE],
    needs=makes_use_of_the_second_answer,
    see="03b_clients_in_bad_company#late-why",
)

survives_a_dying_server = check_of(
    "survives_a_dying_server",
    *FAILS,
    title="A server that dies in the middle of a request ends it with status 1",
    points=1,
    on=DYING,
    needs=asks_once_more,
    see="03_clients_that_survive#kill-why",
)

finds_a_restarted_server = check_of(
    "finds_a_restarted_server",
    model.holds_whatever_servers_do,
    title="A server that dies and comes back is asked again; whatever servers do, every clause holds",
    points=1,
    on=[RESTARTING, ANY_SERVERS],
    needs=makes_use_of_the_second_answer,
    see="03_clients_that_survive#restart-why",
)

copes_with_two_servers = check_of(
    "copes_with_two_servers",
    *ASKS,
    *SUCCEEDS,
    title="Two servers of one name give one status",
    points=1,
    on=TWO,
    needs=enables_then_asks,
    see="03b_clients_in_bad_company#two-why",
)

reports_a_refusal = check_of(
    "reports_a_refusal",
    model.switches_on,
    model.repeats_enable_once,
    *FAILS,
    title="When enable_motors answers success: false, it asks no more, and ends with status 1",
    points=1,
    on=REFUSING,
    needs=enables_then_asks,
    see="03b_clients_in_bad_company#success-why",
)
