"""The failure of a program that ended by itself has one remedy, chosen by its last lines."""

from __future__ import annotations

from typing import Any

import pytest

from autograder.authoring.diagnosis.service_callback import with_callback
from autograder.authoring.evidence import events as ev
from autograder.authoring.requirements.standard import exits_with_status_0
from records import answered, asked, failure_of, run_of, said, stack

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
            "Your service callback of get_status returned nothing, or something other than the response. End every "
            "branch with `return response`.",
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
        (
            said("AssertionError: The 'success' field must be of type 'bool'"),
            "The field success got a value of the wrong type",
        ),
        (
            said("AssertionError: The 'battery' field must be a sub message of type 'BatteryState'"),
            "The field battery takes a message of the type BatteryState, and got something else: None, if no message "
            "has arrived yet. Test `is None` first",
        ),
        (
            said("TypeError: Expected <class 'std_msgs.msg._bool.Bool'>, got <class 'bool'>"),
            "publish() takes a message of the type Bool, and got a bool: make a message, such as Bool(data=…).",
        ),
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
        (
            said("battery.py: error: unrecognized arguments: --ros-args -r __ns:=/robot"),
            "Your program refused --ros-args, with which every ROS program is started.",
        ),
        (said("getopt.GetoptError: option --ros-args not recognized"), "Your program refused --ros-args"),
        (said("OSError: [Errno 28] No space left on device"), "too much to disk"),
        (said("RuntimeError: can't start new thread"), "too many threads or processes"),
        (said("MemoryError"), "too much memory"),
        (said("ModuleNotFoundError: No module named 'std_srv'"), "found no module"),
        (said("ValueError: 3"), "An exception in a callback ends rclpy.spin(), and with it the node."),
    ],
)
def test_a_program_that_ends_with_an_error_gets_an_explanation_of_its_last_line(
    lines: list[Any], next_step: str
) -> None:
    run = run_of(asked(), *lines, ev.NodeExited(t=3.1, returncode=1))
    assert next_step in failure_of(lambda: run.call("first").response).help


def test_a_traceback_that_did_not_end_the_program_is_not_taken_for_the_one_that_did() -> None:
    handled = said("Traceback (most recent call last):", "MemoryError", t=2.5)
    last = said("Traceback (most recent call last):", "ValueError: 3")
    run = run_of(asked(), *handled, *last, ev.NodeExited(t=3.1, returncode=1))
    assert failure_of(lambda: run.call("first").response).help.startswith("An exception in a callback")


def test_for_a_program_that_ignores_ctrl_c_the_running_line_is_reported() -> None:
    run = run_of(
        ev.NodeSignalled(t=8.0, signal="SIGINT"), stack('"/tmp/work/status.py", line 44 in main'), until=13.0
    )
    assert failure_of(exits_with_status_0, run).help.startswith(
        "It was blocked in line 44 of status.py, in main():"
    )


def test_a_crash_below_python_is_named() -> None:
    run = run_of(asked(), *said("Extension modules: rclpy"), ev.NodeExited(t=3.1, returncode=-11))
    assert failure_of(lambda: run.call("first").response).help.startswith("SIGSEGV ended the program")


def test_a_server_that_ends_by_itself_is_advised_to_spin() -> None:
    run = run_of(asked(), answered(), asked("second", t=3.0), ev.NodeExited(t=2.9, returncode=0))
    failure = failure_of(lambda: run.call("second").response)
    assert failure.observed == "the program ended by itself with status 0 after 1 answer"
    assert failure.help.startswith("Use rclpy.spin(node), not spin_once, and do not shut down in a callback")


def test_ctrl_c_is_not_tested_where_the_node_had_already_ended() -> None:
    events = [ev.NodeExited(t=3.1, returncode=1), ev.NodeSignalled(t=8.0, signal="SIGINT")]
    failure = failure_of(exits_with_status_0, run_of(asked(), *NO_RETURN, *events))
    assert failure.observed == "Ctrl-C was not tested: the node had already ended with status 1: TypeError"
    assert "`return response`" in failure.help


def test_too_much_memory_points_to_the_lesson_on_what_grows() -> None:
    killed = ev.NodeKilled(t=3.0, reason="it used 900 MiB of memory; 700 MiB are allowed")
    failure = failure_of(lambda: run_of(asked(), killed).call("first").response)
    assert "keep only the last" in failure.help
    assert failure.see == "03b_clients_in_bad_company#leak-why"


@pytest.mark.parametrize(
    ("last", "said"),
    [
        ("response.message = 'up'", "line 2 of status.py, returned nothing. End"),
        ("return None", "line 2 of status.py, returned nothing, or something other than the response. End"),
    ],
)
def test_self_check_names_the_callback_that_returns_nothing(last, said):
    program = f"class Status(Node):\n    def tell(self, request, response):\n        {last}\n"
    program += "    def __init__(self):\n        self.create_service(Trigger, 'get_status', self.tell)\n"
    advice = (
        "Your service callback of get_status returned nothing, or something other than the response. End it."
    )

    assert f"Your service callback of get_status, tell() in {said} it." in with_callback(
        advice, {"status.py": program}
    )
    assert with_callback(advice, {"status.py": "(" * 1000}) == advice
