"""What only the instructor's grading checks."""

from __future__ import annotations

import random

from autograder.authoring.checks import check, program
from autograder.authoring.client_checks import require_offered, require_reply, require_withdrawn
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

from .advice import ENABLE, STATUS
from .checks import (
    asks_once_more,
    gives_up_without_servers,
    makes_use_of_the_second_answer,
    prints_the_status,
)
from .judging import (
    require_asked_here,
    require_failure,
    require_printed_status,
    require_silence,
    require_slow_answers,
)

SOON = 0.9  # of the time after which an answer is due


def _any_status(generator: random.Random) -> dict[str, str]:
    return {
        "status": f"Motors: ON, {generator.uniform(20, 60):.1f} degC, {generator.randrange(10_000)} steps"
    }


ANY_STATUS = program("good", _any_status)
OTHER_NAMESPACE = program("good", _any_status, namespace="/lab_7/robot")
ONE_OF_TWO = program("one_of_two")
ANOTHER_TYPE = program("another_type")
SILENT_STATUS = program("silent_status")
SLOW = program("slow", lambda generator: _any_status(generator) | {"after": 1.0})
LATE = program("late", {"statuses": ["Motors: OFF", "Motors: ON"], "after": [2.6, 1.2]})
DYING = program("dying")
RESTARTING = program("restarting", _any_status)
TWO = program("two_of_one_name", _any_status)
REFUSING = program("refusing", {"reason": "the emergency stop is pressed"})


@check(points=1, on=ANY_STATUS, needs=prints_the_status, see="03_clients_that_survive#fix-file")
def prints_any_status(run: Transcript) -> None:
    """Whatever the status says, it is printed as it came"""
    require_printed_status(run, [run.params["status"]])


@check(points=1, on=OTHER_NAMESPACE, needs=prints_the_status, see="01_robot_and_graph#names-why")
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it asks the robot there"""
    require_asked_here(run, OTHER_NAMESPACE.namespace)
    require_printed_status(run, [run.params["status"]])


@check(
    points=1,
    on=[ONE_OF_TWO, ANOTHER_TYPE],
    needs=gives_up_without_servers,
    see="03_clients_that_survive#fix-run",
)
def needs_both_services(missing: Transcript, other_type: Transcript) -> None:
    """A get_status that is missing, or of another type, ends it with status 1"""
    require_offered(missing, ENABLE)
    require_offered(missing, STATUS, servers=0)
    require_failure(missing, "nobody offers get_status")
    require_offered(other_type, STATUS, service_type="std_srvs/srv/SetBool")
    require_failure(other_type, "get_status is there with another type")


@check(points=1, on=SILENT_STATUS, needs=asks_once_more, see="03_clients_that_survive#fix-module")
def gives_up_on_a_silent_status(run: Transcript) -> None:
    """get_status is also asked twice and then given up"""
    require_reply(run, ENABLE)
    require_silence(run, STATUS)
    require_failure(run, "get_status has not answered")


@check(points=1, on=SLOW, needs=prints_the_status, see="03_clients_that_survive#fix-why")
def waits_for_slow_answers(run: Transcript) -> None:
    """Answers that take 1 s are waited for"""
    require_printed_status(run, [run.params["status"]])
    require_slow_answers(run, run.params["after"])


@check(points=1, on=LATE, needs=makes_use_of_the_second_answer, see="03b_clients_in_bad_company#late-why")
def is_not_confused_by_a_late_answer(run: Transcript) -> None:
    """An answer that comes after its time, while the next is waited for, does no harm"""
    require_printed_status(run, run.params["statuses"])
    first = run.requests(STATUS)[0]
    if first.reply is None or first.reply.t - first.received.t < SOON * run.params["after"][0]:
        raise unseen(run, "the first answer did not come late")


@check(points=1, on=DYING, needs=asks_once_more, see="03_clients_that_survive#kill-why")
def survives_a_dying_server(run: Transcript) -> None:
    """A server that dies in the middle of a request ends it with status 1"""
    require_withdrawn(run, STATUS)
    require_failure(run, "get_status died before it answered")


@check(
    points=1, on=RESTARTING, needs=makes_use_of_the_second_answer, see="03_clients_that_survive#restart-why"
)
def finds_a_restarted_server(run: Transcript) -> None:
    """A server that dies and comes back is asked again"""
    require_withdrawn(run, STATUS)
    require_printed_status(run, [run.params["status"]])


@check(points=1, on=TWO, needs=prints_the_status, see="03b_clients_in_bad_company#two-why")
def copes_with_two_servers(run: Transcript) -> None:
    """Two servers of one name give one status"""
    require_offered(run, STATUS, servers=2)
    require_printed_status(run, [run.params["status"]])


@check(points=1, on=REFUSING, needs=prints_the_status, see="03b_clients_in_bad_company#success-why")
def reports_a_refusal(run: Transcript) -> None:
    """When enable_motors answers success: false, it ends with status 1"""
    reply = require_reply(run, ENABLE)
    if reply.response.success:
        raise unseen(run, "enable_motors did not refuse")
    require_failure(run, "enable_motors answered success: false")
