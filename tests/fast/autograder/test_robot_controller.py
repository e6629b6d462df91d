"""The failure of a client: the observation from the record, and one next step."""

from itertools import count

import pytest
from std_srvs.srv import SetBool, Trigger

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import exercise_module, load_exercise
from records import failure_of

CHECKS = {check.id: check for check in load_exercise("robot_controller", hidden=True).checks}
MODEL = exercise_module("robot_controller", "model")
ENABLE, STATUS = "enable_motors", "get_status"
ON = SetBool.Response(success=True, message="the motors are on")
REFUSED = SetBool.Response(success=False, message="the emergency stop is pressed")
EMPTY = Trigger.Response(success=True)
STATUS_ON = Trigger.Response(success=True, message="Motors: ON")
TRACEBACK = (
    "Traceback (most recent call last):",
    "AttributeError: 'NoneType' object has no attribute 'message'",
)
NUMBERS = count(1)
END = 26.0  # s


def offered(service, t=0.1, server="server", type_=None):
    types = {ENABLE: "std_srvs/srv/SetBool", STATUS: "std_srvs/srv/Trigger"}
    return [
        ev.ServiceOffered(t=t, service=service, server=f"{server} of {service}", type=type_ or types[service])
    ]


BOTH = [*offered(ENABLE), *offered(STATUS)]


def asked(service, t, answered=None, response=None, server="server"):
    """A request at t, answered at another time or never."""
    name = f"request {next(NUMBERS)}"
    message = SetBool.Request(data=True) if service == ENABLE else Trigger.Request()
    request = ev.RequestReceived(
        t=t, request=name, service=service, server=f"{server} of {service}", message=message
    )
    if answered is None:
        return [request]
    reply = response or (ON if service == ENABLE else STATUS_ON)
    return [request, ev.ReplySent(t=answered, request=name, response=reply)]


def said(t, *lines, stream="stderr"):
    return [ev.NodeOutput(t=t, stream=stream, text=line) for line in lines]


def ended(t, status):
    return [ev.NodeExited(t=t, returncode=status)]


HUNG = [ev.Unanswered(t=END, what="end", id="program", waited=25.0)]
ENABLED = asked(ENABLE, 2.0, 2.1)
PRINTED = said(3.0, "Robot status: Motors: ON", stream="stdout")


def failure(check, *parts, **params):
    """Return how a check fails on one transcript that consists of these events."""
    events = [event for part in parts for event in part]
    begin = [ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0)]
    run = Transcript.from_events("it", params, [*begin, *events, ev.ScenarioEnded(t=END)])
    return failure_of(CHECKS[check].run, [run])


# -- it hangs ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("parts", "where"),
    [
        ([BOTH], "It hung before it sent anything: wait_for_service"),
        ([BOTH, asked(ENABLE, 2.0)], "It hung after request 1 (to enable_motors) was sent and not answered"),
        (
            [BOTH, ENABLED, asked(STATUS, 3.0), asked(STATUS, 5.0)],
            "after request 2 (to get_status) was sent and not answered",
        ),
        (
            [BOTH, *(asked(ENABLE, 2.0 * number) for number in range(1, 8))],
            "It sent 7 requests to enable_motors and never stopped",
        ),
        ([offered(ENABLE), ENABLED], "give each wait for another server a timeout"),
        ([BOTH, ENABLED], "and never called get_status: give wait_for_service a timeout_sec, and spin"),
        ([BOTH, ENABLED, asked(STATUS, 3.0, 3.1)], "It kept running after the last answer"),
    ],
)
def test_for_a_program_that_hangs_the_running_line_is_reported(parts, where):
    assert where in failure("prints_the_status", *parts, HUNG, status="Motors: ON").help


def test_a_program_that_waits_for_a_dead_server_gets_that_explanation():
    gone = [ev.ServiceWithdrawn(t=3.5, service=STATUS, server=f"server of {STATUS}")]
    told = failure("survives_a_dying_server", BOTH, ENABLED, asked(STATUS, 3.0), gone, HUNG)
    assert "It hung after request 1 (to get_status) was sent, and the server died" in told.help


# -- it fails where all would have gone well --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("parts", "observed", "what_to_do"),
    [
        (
            [BOTH, asked(ENABLE, 2.0), asked(ENABLE, 4.0, 4.1), ended(6.0, 1)],
            "Exit status 1, although request 2 to enable_motors got a response",
            "use the response to the second request",
        ),
        (
            [BOTH, asked(ENABLE, 2.0, 3.0), asked(ENABLE, 2.5), ended(3.1, 1)],
            "the retry after 0.5 s",
            "timeout_sec=2.0",
        ),
        (
            [
                BOTH,
                ENABLED,
                asked(STATUS, 3.0),
                asked(STATUS, 5.0, 6.2),
                said(5.5, "no answer"),
                ended(6.4, 1),
            ],
            "It gave up 0.5 s after request 2 to get_status, before the response came.",
            "timeout_sec=2.0",
        ),
        (
            [BOTH, asked(ENABLE, 2.0, 3.0), asked(ENABLE, 4.0, 5.0), ended(6.0, 1)],
            "2 requests, although the response to the first came after 1.0 s",
            "during time.sleep no response is processed",
        ),
        (
            [BOTH, ENABLED, asked(STATUS, 3.0, 3.1), PRINTED, ended(3.2, 1)],
            "Exit status 1, although both services responded",
            "Return 0 from main()",
        ),
        (
            [BOTH, ENABLED, asked(STATUS, 3.0, 3.1, EMPTY), said(3.2, "no status"), ended(3.3, 1)],
            "Exit status 1, although get_status responded with success: true, message: ''.",
            "also with an empty message",
        ),
        (
            [BOTH, ENABLED, said(3.0, *TRACEBACK), ended(3.2, 1)],
            f"the node had ended at 3.2 s, with status 1: {TRACEBACK[1]}",
            "None",
        ),
        (
            [BOTH, offered(STATUS, server="another"), ENABLED, ended(3.2, 1)],
            "the node had ended at 3.2 s, with status 1",
            "although the grader offered",
        ),
        (
            [BOTH, ENABLED, said(5.0, "nobody offers /robot/robot_status"), ended(5.2, 1)],
            "with status 1: nobody offers /robot/robot_status",
            "that all names are relative",
        ),
    ],
)
def test_for_a_program_that_gives_up_too_early_the_missed_answer_is_reported(parts, observed, what_to_do):
    failed = failure("prints_the_status", *parts, status="Motors: ON")
    assert failed.observed.startswith(observed) or observed in failed.observed
    assert what_to_do in failed.help


@pytest.mark.parametrize(
    ("output", "what_to_do"),
    [
        (said(3.0, "[INFO] [robot_controller]: Robot status: Motors: ON"), "where loggers write"),
        ([], "Add print(f'Robot status: {response.message}')"),
        ([*PRINTED, *PRINTED], "Print only once"),
        ([*asked(STATUS, 2.0, 2.9), *PRINTED, *PRINTED], "remove_pending_request"),
        (said(3.0, "Robot status: ON", stream="stdout"), "the whole message"),
    ],
)
def test_what_is_wrong_with_the_printed_line(output, what_to_do):
    answered = asked(STATUS, 2.5, 2.6)
    failed = failure("prints_the_status", BOTH, ENABLED, answered, output, ended(3.2, 0), status="Motors: ON")
    assert what_to_do in failed.help


def test_a_program_in_another_namespace_that_finds_nobody_has_a_slash_too_many():
    told = failure("works_in_any_namespace", BOTH, said(3.0, "nobody offers it"), ended(3.2, 1), status="it")
    assert told.expected == "a request to enable_motors in the namespace in which the program was started"
    assert "that all names are relative" in told.help


# -- it does not fail as it should ------------------------------------------------------------------------------------


def test_a_refusal_that_is_not_looked_at():
    refused, went_on = asked(ENABLE, 2.0, 2.1, REFUSED), asked(STATUS, 2.2, 2.3)
    told = failure("reports_a_refusal", BOTH, refused, went_on, PRINTED, ended(3.2, 0))
    assert (
        told.observed == "Your client called get_status although enable_motors responded with success false."
    )
    assert told.help == "If response.success of enable_motors is false, print the reason and return 1."


@pytest.mark.parametrize("status", [2, 3])
def test_a_refusal_is_exit_status_1_like_every_other_failure(status):
    refused, words = asked(ENABLE, 2.0, 2.1, REFUSED), said(2.2, "the motors stay off")
    told = failure("reports_a_refusal", BOTH, refused, words, ended(2.4, status))
    assert told.expected == "exit status 1, because enable_motors responded with success false"
    assert told.observed == f"exit status {status}; the last line on stderr: the motors stay off"
    assert "2 to 4 are for action goals" in told.help


def test_an_exit_status_that_main_does_not_return_is_explained():
    failed = failure("gives_up_without_servers", said(3.0, "no server"), ended(3.2, 0))
    assert failed.observed == "exit status 0; the last line on stderr: no server"
    assert "sys.exit(main())" in failed.help


@pytest.mark.parametrize(
    ("requests", "observed", "what_to_do"),
    [
        (1, "1 request, then it gave up", "send the request once more"),
        (7, "7 requests", "Retry only once"),
    ],
)
def test_too_few_and_too_many_requests(requests, observed, what_to_do):
    sent = [asked(ENABLE, 2.0 * number) for number in range(1, requests + 1)]
    gave_up = 2.0 * requests + 2.0
    failed = failure("asks_once_more", BOTH, *sent, said(gave_up, "no answer"), ended(gave_up + 0.1, 1))
    assert failed.observed == observed
    assert what_to_do in failed.help


@pytest.mark.parametrize(("second", "what_to_do"), [(2.5, "too early"), (6.5, "too late")])
def test_a_pause_that_is_too_short_or_too_long(second, what_to_do):
    failed = failure("asks_once_more", BOTH, asked(ENABLE, 2.0), asked(ENABLE, second), ended(9.0, 1))
    assert what_to_do in failed.help


@pytest.mark.parametrize("first", [asked(STATUS, 3.0), asked(STATUS, 3.0, 5.4)])
def test_a_second_request_that_gets_too_little_time(first):
    ends = ended(5.6, 1)
    failed = failure(
        "is_not_confused_by_a_late_answer", BOTH, ENABLED, first, asked(STATUS, 5.0), said(5.5, "no"), ends
    )
    assert failed.observed == "it gave up 0.5 s after the second request"
    assert "up to 2 s" in failed.help


def test_a_refusal_that_is_asked_again():
    refused, again = asked(ENABLE, 2.0, 2.1, REFUSED), asked(ENABLE, 4.0, 4.1, REFUSED)
    told = failure("reports_a_refusal", BOTH, refused, again, said(4.2, "refused"), ended(4.3, 1))
    assert told.observed == "2 requests, although the response to the first came after 0.1 s"
    assert "give up without a retry" in told.help


def test_the_data_of_the_second_request():
    second = [
        ev.RequestReceived(
            t=4.0, request="r", service=ENABLE, server=f"server of {ENABLE}", message=SetBool.Request()
        )
    ]
    told = failure("asks_once_more", BOTH, asked(ENABLE, 2.0), second, said(6.0, "silent"), ended(6.1, 1))
    assert told.observed == "data: false in the retry"


# -- one deadline over everything -------------------------------------------------------------------------------------


def late(gave_up, exited):
    """The servers appear late, and the second get_status is sent at 8 s of the program's own time."""
    servers = [*offered(ENABLE, 2.6), *offered(STATUS, 7.2)]
    enable = [*asked(ENABLE, 2.8), *asked(ENABLE, 4.8, 6.5)]
    status = [*asked(STATUS, 7.3), *asked(STATUS, 9.3)]
    return [servers, enable, status, said(gave_up, "get_status does not answer"), ended(exited, 1)]


def run_of(parts):
    begin = [ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0)]
    events = [*begin, *(event for part in parts for event in part), ev.ScenarioEnded(t=END)]
    return Transcript.from_events("late_and_silent", {"appears": 1.6, "answers": 1.7}, events)


@pytest.mark.parametrize(("gave_up", "exited"), [(10.4, 10.9), (11.1, 11.6), (11.6, 12.6)])
def test_a_deadline_of_10_s_is_kept_also_where_the_program_takes_its_time_to_end(gave_up, exited):
    CHECKS["keeps_one_deadline"].run([run_of(late(gave_up, exited))])


def test_separate_timeouts_do_not_make_a_deadline():
    failed = failure_of(CHECKS["keeps_one_deadline"].run, [run_of(late(12.2, 12.5))])
    assert failed.observed == "it gave up after 11.2 s; get_status was called after 6.3 s and 8.3 s"
    assert "the remaining time as the limit" in failed.help


def test_the_scenario_distinguishes_programs_with_and_without_a_deadline():
    """Without a deadline the waits exceed the limit, whether the servers are searched for in parallel or in turn."""
    scenario, _refused = CHECKS["keeps_one_deadline"].on
    appears, answers = scenario.draw(0)["appears"], scenario.draw(0)["answers"]
    assert appears < 2.0 > answers
    assert 2 * appears + 2.0 + answers + 2 * 2.0 > MODEL.WHOLE_DEADLINE + MODEL.DEADLINE_SLACK


def test_a_program_that_looks_for_both_servers_at_once_may_find_one_missing_and_ask_nothing():
    servers = [*offered(ENABLE, 2.6), *offered(STATUS, 4.2)]
    CHECKS["keeps_one_deadline"].run(
        [run_of([servers, said(3.1, "nobody offers get_status"), ended(3.2, 1)])]
    )


# -- how long it looks for a server -----------------------------------------------------------------------------------


@pytest.mark.parametrize("gave_up", [3.0, 5.2])
def test_a_program_may_look_for_both_servers_at_once_or_in_turn(gave_up):
    run = run_of([said(gave_up, "nobody is there"), ended(gave_up + 0.2, 1)])
    assert MODEL.looks_for_two_seconds.judge(run)


@pytest.mark.parametrize(
    ("parts", "observed"),
    [
        ([said(1.3, "nobody is there"), ended(1.5, 1)], "it gave up 0.3 s after its start"),
        ([said(7.1, "nobody is there"), ended(7.3, 1)], "it gave up 6.1 s after its start"),
        (
            [offered(ENABLE), ENABLED, said(7.1, "no get_status"), ended(7.3, 1)],
            "it gave up 5.0 s after the response of enable_motors",
        ),
    ],
)
def test_a_search_that_is_too_short_or_too_long(parts, observed):
    failed = failure_of(MODEL.looks_for_two_seconds.judge, run_of(parts))
    assert failed.observed == observed
    assert "timeout_sec=2.0" in failed.help
