"""The next step of a failure is one remedy, chosen by what the transcript knows, and not a list of them."""

from __future__ import annotations

from typing import Any

import pytest
from std_srvs.srv import SetBool, Trigger

from autograder.authoring import events as ev
from autograder.authoring.client_checks import require_end, require_requests
from autograder.authoring.failure import Failure
from autograder.authoring.goal import ABORTED, CANCELED, SUCCEEDED
from autograder.authoring.readiness import require_ready
from autograder.authoring.server_checks import require_clean_exit
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking import truth as walking_truth
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from ros_runtime.message_constants import GoalStatus

READY = (ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0))
PEERS = ev.RobotPeers(
    t=0.9, subscribers={"/robot/robot_state": 1}, publishers={"/robot/motor_power": 1, "/robot/cmd_vel": 0}
)
MOTORS = exercise_module("motor_services", "judging")
IN_EXECUTE = '  File "/tmp/work/walk.py", line 97, in execute'


def robot(t: float, *, motors: bool = True, mode: int = RobotState.STANDING, **more: float) -> Any:
    numbers = (
        dict.fromkeys(("x", "y", "z", "yaw", "speed", "turn_rate", "steps", "lag"), 0) | {"up": 1} | more
    )
    return ev.RobotTruth(t=t, simulated=t, mode=mode, motors_enabled=motors, battery=1, **numbers)


def run_of(*events: Any, ready: bool = True, until: float = 20.0) -> Transcript:
    return Transcript.from_events(
        "any", {}, [*(READY if ready else READY[:1]), *events, ev.ScenarioEnded(t=until)]
    )


def failure_of(question: Any, *arguments: Any, **options: Any) -> Failure:
    with pytest.raises(Failure) as caught:
        question(*arguments, **options)
    return caught.value


def said(*lines: str, t: float = 3.0) -> list[Any]:
    return [ev.NodeOutput(t=t, stream="stderr", text=line) for line in lines]


def asked(call: str = "first", service: str = "get_status", *, t: float = 2.0, request: Any = None) -> Any:
    return ev.ServiceCalled(t=t, call=call, service=service, request=request or Trigger.Request())


def answered(call: str = "first", *, t: float = 2.1, response: Any = None) -> Any:
    return ev.ServiceAnswered(t=t, call=call, response=response or Trigger.Response(success=True))


def given_up(what: Any, name: str, t: float = 7.0) -> Any:
    return ev.Unanswered(t=t, what=what, id=name, waited=5.0)


# -- a program that ended by itself -----------------------------------------------------------------------------------

NO_RETURN = said(
    "Traceback (most recent call last):",
    '  File "/tmp/work/status.py", line 40, in main',
    '  File "/x/rclpy/__init__.py", line 247, in spin',
    '  File "/x/rclpy/service.py", line 60, in send_response',
    "    raise TypeError()",
    "TypeError",
)


@pytest.mark.parametrize(
    ("lines", "next_step"),
    [
        (
            NO_RETURN,
            "Your service callback of get_status returned nothing, or something else than the response. Its last line "
            "must be `return response`, in every branch.",
        ),
        (
            said(
                '  File "/tmp/work/status.py", line 21, in on_request',
                "AttributeError: 'NoneType' object has no attribute 'mode'",
            ),
            "A variable is still None, because no message has arrived yet: test `is None` before you use it. It was "
            "raised in line 21 of status.py, in on_request().",
        ),
        (said("AttributeError: 'Trigger_Response' object has no attribute 'text'"), "no field of that name"),
        (said("AssertionError: The 'success' field must be of type 'bool'"), "a value of the wrong type"),
        (
            [
                *said(
                    "RCLError: goal_handle attempted invalid transition from state EXECUTING with event CANCELED"
                ),
                *said("[WARN] [1795378757.2] [walk]: Goal state not set, assuming aborted."),
            ],
            "goal_handle.canceled() was called while the goal was EXECUTING.",
        ),
        (said("RuntimeError: no running event loop"), "no asyncio event loop"),
        (said("OSError: [Errno 28] No space left on device"), "too much to disk"),
        (said("RuntimeError: can't start new thread"), "too many threads or processes"),
        (said("MemoryError"), "too much memory"),
        (said("ModuleNotFoundError: No module named 'std_srv'"), "could not load the file"),
        (said("ValueError: 3"), "An exception in a callback ends rclpy.spin(), and with it the node."),
    ],
)
def test_a_program_that_ends_with_an_error_is_told_what_its_last_words_mean(
    lines: list[Any], next_step: str
) -> None:
    run = run_of(asked(), *lines, ev.NodeExited(t=3.1, returncode=1))
    assert next_step in failure_of(lambda: run.call("first").response).help


def test_a_traceback_that_did_not_end_the_program_is_not_taken_for_the_one_that_did() -> None:
    handled = said("Traceback (most recent call last):", "MemoryError", t=2.5)
    last = said("Traceback (most recent call last):", "ValueError: 3")
    run = run_of(asked(), *handled, *last, ev.NodeExited(t=3.1, returncode=1))
    assert failure_of(lambda: run.call("first").response).help.startswith("An exception in a callback")


def test_a_program_that_does_not_end_on_ctrl_c_is_told_where_it_stood() -> None:
    run = run_of(
        ev.NodeSignalled(t=8.0, signal="SIGINT"), stack('"/tmp/work/status.py", line 44 in main'), until=13.0
    )
    assert failure_of(require_clean_exit, run).help.startswith("It stood in line 44 of status.py, in main():")


def test_a_crash_below_python_is_named() -> None:
    run = run_of(asked(), *said("Extension modules: rclpy"), ev.NodeExited(t=3.1, returncode=-11))
    assert failure_of(lambda: run.call("first").response).help.startswith("SIGSEGV ended the program")


def test_a_silent_server_is_told_that_its_topic_went_on() -> None:
    published = [
        ev.BatteryPublished(t=2.5 + second, percentage=0.5, voltage=30.0, current=-1.0) for second in range(4)
    ]
    failure = failure_of(
        lambda: run_of(asked(), *published, given_up("call", "first")).call("first").response
    )
    assert failure.observed == "none within 5 s; the robot published battery_state 4 times meanwhile"


def test_a_server_that_ends_by_itself_is_told_to_spin() -> None:
    run = run_of(asked(), answered(), asked("second", t=3.0), ev.NodeExited(t=2.9, returncode=0))
    failure = failure_of(lambda: run.call("second").response)
    assert failure.observed == "the program ended by itself with status 0 after 1 answer"
    assert failure.help.startswith("Use rclpy.spin(node), not spin_once, and do not shut down in a callback")


def test_ctrl_c_is_not_tested_where_the_node_had_already_ended() -> None:
    events = [ev.NodeExited(t=3.1, returncode=1), ev.NodeSignalled(t=8.0, signal="SIGINT")]
    failure = failure_of(require_clean_exit, run_of(asked(), *NO_RETURN, *events))
    assert failure.observed == "Ctrl-C was not tested: the node had already ended with status 1: TypeError"
    assert "`return response`" in failure.help


def test_too_much_memory_points_to_the_lesson_on_what_grows() -> None:
    killed = ev.NodeKilled(t=3.0, reason="it used 900 MiB of memory; 700 MiB are allowed")
    failure = failure_of(lambda: run_of(asked(), killed).call("first").response)
    assert "keep only the last" in failure.help
    assert failure.see == "03b_clients_in_bad_company#leak-why"


# -- a program that gives no answer -----------------------------------------------------------------------------------


def stack(*frames: str, t: float = 21.0) -> Any:
    lines = ["Fatal Python error: Aborted", "", "Current thread 0x01 (most recent call first):"]
    return ev.NodeStack(t=t, lines=[*lines, *(f"  File {frame}" for frame in frames)])


SPINNING = ('"/x/rclpy/executors.py", line 7 in spin_once', '"/tmp/work/status.py", line 50 in main')


@pytest.mark.parametrize(
    ("frames", "next_step"),
    [
        (
            ('"/tmp/work/status.py", line 29 in on_request', '"/x/rclpy/executors.py", line 9 in spin_once'),
            "It stood in line 29 of status.py, in on_request().",
        ),
        (
            ('"/x/rclpy/client.py", line 5 in call', '"/tmp/work/status.py", line 30 in on_request'),
            "It stood in line 30 of status.py, in on_request(), in a call of call().",
        ),
        (
            ('"/tmp/work/status.py", line 44 in main', '"/tmp/work/status.py", line 60 in <module>'),
            "it stood in line 44 of status.py, in main(), and not in rclpy.spin(node).",
        ),
        (SPINNING, "a callback awaits what never comes"),
    ],
)
def test_a_server_that_gives_no_answer_is_told_where_it_stood(
    frames: tuple[str, ...], next_step: str
) -> None:
    run = run_of(asked(), given_up("call", "first"), stack(*frames))
    failure = failure_of(lambda: run.call("first").response)
    assert failure.observed == "none within 5 s"
    assert next_step in failure.help
    assert failure.see == (
        "02_services#first-intro" if "not in rclpy.spin" in next_step else "02_services#m4-why"
    )


def offered(service: str) -> Any:
    return ev.ServiceOffered(t=0.0, service=service, server="server 1", type="std_srvs/srv/Trigger")


def request(number: int, t: float = 2.0) -> Any:
    return ev.RequestReceived(
        t=t, request=f"request {number}", service="get_status", server="server 1", message=Trigger.Request()
    )


def reply(number: int, t: float = 2.2) -> Any:
    return ev.ReplySent(t=t, request=f"request {number}", response=Trigger.Response())


@pytest.mark.parametrize(
    ("events", "next_step"),
    [
        ([], "It hung before it sent anything: wait_for_service or wait_for_server has no timeout_sec"),
        ([request(1), reply(1), request(2, t=3.0)], "It hung after request 2 (to get_status) was sent"),
        ([request(1), reply(1)], "It went on after the last answer, at 2.2 s: do not spin after it"),
    ],
)
def test_a_client_that_never_ends_is_told_at_which_of_three_places(events: list[Any], next_step: str) -> None:
    failure = failure_of(require_end, run_of(offered("get_status"), *events), 10.0)
    assert failure.help.startswith(next_step)


@pytest.mark.parametrize(
    ("sent", "wanted", "next_step"),
    [
        (0, 2, "Your program never asked get_status"),
        (1, 2, "Only one request, then it gave up. Where is the second try?"),
        (7, 2, "7 requests: one retry is allowed."),
        (2, 1, "2 requests: 1 would do."),
    ],
)
def test_the_number_of_requests_says_whether_a_try_is_missing(sent: int, wanted: int, next_step: str) -> None:
    run = run_of(offered("get_status"), *(request(number, t=number) for number in range(1, sent + 1)))
    assert failure_of(require_requests, run, "get_status", wanted).help.startswith(next_step)


# -- near misses of names ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("offers", "next_step"),
    [
        ([], "Your node offers no service: create the server in the node's constructor"),
        (
            ["/get_status [std_srvs/srv/Trigger]"],
            "You offer /get_status, outside the namespace: remove the slash.",
        ),
        (["/robot/motors/get_status [std_srvs/srv/Trigger]"], "give the name 'get_status' alone"),
        (["/robot/get_state [std_srvs/srv/Trigger]"], "You offer get_state; the task's name is get_status"),
        (
            ["/robot/get_status [std_srvs/srv/SetBool]"],
            "You offer get_status as std_srvs/srv/SetBool: give the",
        ),
        (["/robot/enable_motors [std_srvs/srv/SetBool]"], "You offer enable_motors, but not get_status"),
    ],
)
def test_an_endpoint_that_is_missing_is_explained_by_the_nearest_one(
    offers: list[str], next_step: str
) -> None:
    absent = ev.NodeNotReady(t=5.0, missing=["get_status"], offered=offers, waited=5.0)
    assert next_step in failure_of(require_ready, run_of(PEERS, absent, ready=False)).help


# -- goals ------------------------------------------------------------------------------------------------------------


def goal_run(*events: Any, accepted: bool = True) -> Any:
    sent = ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal())
    answer = ev.GoalAnswered(t=2.1, goal="walk", accepted=accepted)
    return run_of(sent, answer, *events).goal("walk")


def status(value: int, t: float = 2.2) -> Any:
    return ev.StatusSeen(t=t, goal="walk", status=value)


def feedback(t: float) -> Any:
    return ev.FeedbackReceived(t=t, goal="walk", feedback=WalkTo.Feedback(distance_remaining=0.31))


def result(value: int, t: float = 4.0) -> Any:
    return ev.ResultReceived(t=t, goal="walk", status=value, result=WalkTo.Result())


NO_RESULT = given_up("result", "walk", t=12.0)


@pytest.mark.parametrize(
    ("events", "next_step"),
    [
        (
            [status(GoalStatus.EXECUTING), feedback(11.8)],
            "execute is still in its loop, 0.31 m from the goal. What ends it?",
        ),
        (
            [status(GoalStatus.CANCELING), feedback(11.8)],
            "The cancel was accepted: look at goal_handle.is_cancel",
        ),
        ([status(GoalStatus.ACCEPTED)], "nobody called goal_handle.execute()"),
        (
            [status(GoalStatus.SUCCEEDED), stack(*SPINNING)],
            "Nothing of your node is served any more: a spin inside",
        ),
        (
            [status(GoalStatus.SUCCEEDED), stack('"/tmp/work/walk.py", line 9 in execute')],
            "execute has not returned since",
        ),
        (
            [
                status(GoalStatus.EXECUTING),
                *(feedback(2.5 + second) for second in range(10)),
                *(robot(float(second), x=0.1 * second) for second in range(20)),
            ],
            "distance_remaining stayed 0.31 m in all 10 feedback messages: no message of odom is served",
        ),
        ([status(GoalStatus.SUCCEEDED)], "execute returned no result: its last line must be `return result`"),
        (
            [status(GoalStatus.EXECUTING), feedback(3.0), stack('"/tmp/work/walk.py", line 9 in execute')],
            "something in it waits without a time limit. It stood in line 9 of walk.py, in execute().",
        ),
    ],
)
def test_a_goal_without_a_result_is_explained_by_its_status_and_feedback(
    events: list[Any], next_step: str
) -> None:
    failure = failure_of(goal_run(*events, NO_RESULT).require_result, SUCCEEDED)
    assert next_step in failure.help
    assert "make one terminal call" not in failure.help


RAISED = said("[ERROR] [walk]: Error raised in execute callback: no odom", IN_EXECUTE)
FORBIDDEN = said(
    "Error raised in execute callback: attempted invalid transition from state EXECUTING with event CANCELED",
    IN_EXECUTE,
)


@pytest.mark.parametrize(
    ("lines", "next_step"),
    [
        (RAISED, "execute raised an exception in line 97 of walk.py, in execute(): no odom."),
        (
            FORBIDDEN,
            "execute called goal_handle.canceled() in line 97 of walk.py, in execute(), but nobody had asked",
        ),
        (
            said("Goal state not set, assuming aborted. Goal ID: 1"),
            "execute returned without a terminal call",
        ),
        ([], "execute called goal_handle.abort(): look at what led there."),
    ],
)
def test_an_aborted_goal_is_told_who_aborted_it(lines: list[Any], next_step: str) -> None:
    failure = failure_of(goal_run(*lines, result(ABORTED)).require_result, SUCCEEDED)
    assert failure.help.startswith(next_step)


def test_a_check_says_itself_what_a_goal_that_went_on_has_missed() -> None:
    on = goal_run(status(GoalStatus.EXECUTING), feedback(11.8), NO_RESULT)
    assert failure_of(on.require_result, ABORTED, "It fell.").help == "It fell."
    assert failure_of(goal_run(result(SUCCEEDED)).require_result, ABORTED, "It fell.").help == "It fell."
    canceled = goal_run(result(CANCELED)).require_result
    assert "goal_handle.abort()" in failure_of(canceled, ABORTED, "It fell.").help


def test_a_cancel_after_an_early_end_is_about_that_end() -> None:
    events = [
        *RAISED,
        result(ABORTED),
        ev.CancelSent(t=6.0, cancel="1", goal="walk", by="client"),
        ev.CancelAnswered(t=6.1, cancel="1", return_code=3, canceling=[]),
    ]
    failure = failure_of(goal_run(*events).require_canceled)
    assert failure.observed == "it had ended ABORTED at 4.0 s"
    assert "execute raised an exception" in failure.help


def test_a_goal_callback_that_raises_is_told_to_reject() -> None:
    sent = ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal())
    goal = run_of(sent, *said("ValueError: no"), ev.NodeExited(t=3.1, returncode=1)).goal("walk")
    assert "return GoalResponse.REJECT instead" in failure_of(goal.require_rejected, because="", help="").help


@pytest.mark.parametrize(
    ("x", "claimed", "next_step"),
    [
        (0.05, 0.05, "The position is right, the heading is 0.50 rad off"),
        (0.30, 0.31, "Your own feedback said that 0.31 m were left, and then came succeed()"),
        (0.90, 0.05, "Your feedback said that 0.05 m were left: measure from odom's pose to the goal"),
        (0.90, None, "Compare odom with the goal's pose"),
    ],
)
def test_a_robot_that_has_not_arrived_is_told_which_test_was_too_generous(
    x: float, claimed: float | None, next_step: str
) -> None:
    sent = ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal())
    sent.request.target_pose.pose.orientation.w = 1.0
    came = [] if claimed is None else [WalkTo.Feedback(distance_remaining=claimed)]
    events = [
        sent,
        ev.GoalAnswered(t=2.1, goal="walk", accepted=True),
        *(ev.FeedbackReceived(t=3.9, goal="walk", feedback=message) for message in came),
        result(SUCCEEDED),
        *(robot(tenth / 10, x=x, yaw=0.5) for tenth in range(100)),
    ]
    walk = walking_truth
    assert failure_of(walk.require_arrival, run_of(*events).goal("walk")).help.startswith(next_step)


# -- motor services ---------------------------------------------------------------------------------------------------


def truth(*, motors: Any = lambda t: True, mode: int = RobotState.STANDING) -> list[Any]:
    return [robot(tenth / 10, motors=motors(tenth / 10), mode=mode) for tenth in range(200)]


def topics(*publishes: str, subscribes: tuple[str, ...] = ()) -> Any:
    return ev.NodeTopics(t=1.1, publishes=list(publishes), subscribes=list(subscribes))


def peers(t: float, publishers: int, subscribers: int = 0) -> Any:
    return ev.RobotPeers(
        t=t,
        subscribers={"/robot/robot_state": subscribers},
        publishers={"/robot/motor_power": publishers},
    )


def switch(call: str, on: bool, t: float, *, success: bool = True, message: str = "") -> list[Any]:
    return [
        asked(call, "enable_motors", t=t, request=SetBool.Request(data=on)),
        answered(call, t=t + 0.1, response=SetBool.Response(success=success, message=message)),
    ]


@pytest.mark.parametrize(
    ("events", "seen"),
    [
        ([peers(0.9, 0), topics()], "no publisher"),
        ([peers(0.9, 0), topics("/motor_power")], "a publisher on /motor_power: remove the slash"),
        ([peers(0.9, 0), topics(), peers(9.0, 1)], "a publisher that appeared after the request"),
        ([peers(0.9, 1), topics("/robot/motor_power")], "no message after the request"),
        ([peers(0.9, 1), topics("/robot/motor_power"), ev.MotorPowerReceived(t=4.1, on=True)], "data: true"),
    ],
)
def test_motors_that_stay_on_are_explained_by_what_came_on_motor_power(events: list[Any], seen: str) -> None:
    run = run_of(*truth(), *events, *switch("off", False, 4.0))
    failure = failure_of(MOTORS.require_switched, run.call("off"))
    assert failure.help.startswith(f"On motor_power the grader saw {seen}")


def statuses(*said_on: bool) -> list[Any]:
    events = []
    for number, on in enumerate(said_on):
        response = Trigger.Response(success=True, message=f"Motors: {'ON' if on else 'OFF'}")
        call = f"status {number}"
        events += [asked(call, t=3.0 + 4 * number), answered(call, t=3.1 + 4 * number, response=response)]
    return events


def off_from_5_to_9(t: float) -> bool:
    return not 5.0 <= t < 9.0


@pytest.mark.parametrize(
    ("events", "call", "next_step"),
    [
        (statuses(True, True, True), "status 1", "get_status never changed, though the robot's motors did."),
        (statuses(False, True, False), "status 0", "get_status said the opposite of the robot"),
        (
            [*statuses(True, True, True), *switch("on", True, 2.0)],
            "status 1",
            "get_status followed your last request, not the robot.",
        ),
        (
            [peers(0.9, 0, 0), topics(), *statuses(True, True, True)],
            "status 1",
            "Your node does not subscribe to robot_state.",
        ),
        (
            [peers(0.9, 0, 0), topics(subscribes=("/robot_state",)), *statuses(True, True)],
            "status 1",
            "You subscribe to /robot_state, which the robot does not publish: remove the slash",
        ),
    ],
)
def test_a_wrong_status_is_explained_by_the_answers_so_far(
    events: list[Any], call: str, next_step: str
) -> None:
    run = run_of(*truth(motors=off_from_5_to_9), *events)
    failure = failure_of(MOTORS.require_status, run.call(call), on=call != "status 1")
    assert failure.help.startswith(next_step)
    lesson = {
        "Your node does not": "01_robot_and_graph#listen-intro",
        "You subscribe": "01_robot_and_graph#names-why",
    }
    assert failure.see == next((see for words, see in lesson.items() if next_step.startswith(words)), "")


@pytest.mark.parametrize(
    ("motors", "message", "next_step"),
    [
        (
            lambda t: True,
            "not while it walks",
            "Nothing was switched off, and the message refuses, but success is true",
        ),
        (lambda t: True, "", "Nothing was switched off, but success is true"),
        (lambda t: t < 4.0, "power off", "Answer success: false, before you publish"),
    ],
)
def test_a_refusal_that_says_success_is_told_from_none(motors: Any, message: str, next_step: str) -> None:
    walk = ev.RobotCommanded(t=2.0, command={"do": "walk", "velocity": [0.3, 0.0, 0.0]})
    off = switch("off", False, 4.0, message=message)
    run = run_of(*truth(motors=motors, mode=RobotState.WALKING), walk, *off)
    assert failure_of(MOTORS.require_refused, run.call("off")).help.startswith(next_step)
