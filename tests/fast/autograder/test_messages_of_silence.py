"""The failure of a program that does not answer names the running line; that of a wrong name, the nearest one."""

from __future__ import annotations

from typing import Any

import pytest
from sensor_msgs.msg import BatteryState
from std_srvs.srv import Trigger

from autograder.authoring.diagnosis.readiness import require_ready
from autograder.authoring.evidence import events as ev
from autograder.authoring.requirements.client_checks import require_end
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.srv import GetBatteryStatus
from records import PEERS, SPINNING, answered, asked, failure_of, given_up, run_of, stack


@pytest.mark.parametrize(
    ("frames", "next_step"),
    [
        (
            ('"/tmp/work/status.py", line 29 in on_request', '"/x/rclpy/executors.py", line 9 in spin_once'),
            "It was blocked in line 29 of status.py, in on_request().",
        ),
        (
            ('"/x/rclpy/client.py", line 5 in call', '"/tmp/work/status.py", line 30 in on_request'),
            "It was blocked in line 30 of status.py, in on_request(), which called call().",
        ),
        (
            ('"/tmp/work/status.py", line 44 in main', '"/tmp/work/status.py", line 60 in <module>'),
            "it was in line 44 of status.py, in main(), and not in rclpy.spin(node).",
        ),
        (
            (
                '"/x/rclpy/executors.py", line 5 in spin_until_future_complete',
                '"/tmp/work/status.py", line 31 in on_request',
                '"/x/rclpy/executors.py", line 9 in spin',
            ),
            "It was blocked in line 31 of status.py, in on_request(), which called spin_until_future_complete().",
        ),
        (
            ('"/x/rclpy/__init__.py", line 5 in spin', '"/tmp/work/status.py", line 50 in run'),
            "a callback awaits something that never completes",
        ),
        (SPINNING, "a callback awaits something that never completes"),
    ],
)
def test_for_a_server_without_an_answer_the_running_line_is_reported(
    frames: tuple[str, ...], next_step: str
) -> None:
    run = run_of(asked(), given_up("call", "first"), stack(*frames))
    failure = failure_of(lambda: run.call("first").response)
    assert failure.expected == "an answer to get_status"
    assert failure_of(run.call("first").answered_within, 2.0).expected == "an answer to get_status within 2 s"
    assert failure.observed == "none after 5 s of waiting"
    assert next_step in failure.help
    lessons = {
        "not in rclpy.spin": "02_services#first-intro",
        "awaits something": "05_executors#report-why",
        "It was blocked": "02_services#m4-why",
    }
    assert failure.see == next(lesson for words, lesson in lessons.items() if words in next_step)


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
        ([request(1), reply(1)], "It kept running after the last answer, at 2.2 s: do not spin after it"),
    ],
)
def test_for_a_client_that_never_ends_one_of_three_causes_is_reported(
    events: list[Any], next_step: str
) -> None:
    failure = failure_of(require_end, run_of(offered("get_status"), *events), 10.0)
    assert failure.help.startswith(next_step)


@pytest.mark.parametrize(
    ("offers", "next_step"),
    [
        ([], "Your node offers no service: create the server in the node's constructor"),
        (
            ["/get_status [std_srvs/srv/Trigger]"],
            "You offer /get_status, outside the namespace: remove the slash.",
        ),
        (["/robot/motors/get_status [std_srvs/srv/Trigger]"], "use the name 'get_status' alone"),
        (
            ["/robot/get_state [std_srvs/srv/Trigger]"],
            "You offer get_state; the task requires exactly the name get_status",
        ),
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


def test_a_battery_that_is_empty_is_explained_by_the_missing_subscription_or_named() -> None:
    published = [ev.BatteryPublished(t=t, message=BatteryState(percentage=0.9)) for t in (1.5, 2.0, 2.5)]
    request = asked("first", "get_battery_status", t=3.0, request=GetBatteryStatus.Request())
    empty = answered("first", t=3.1, response=GetBatteryStatus.Response(available=True))
    model = exercise_module("battery_service", "model")
    for count, help in ((0, "Your node does not subscribe to battery_state."), (1, "battery is still empty")):
        peers = ev.RobotPeers(t=0.9, subscribers={"/robot/battery_state": count}, publishers={})
        seen = [peers, ev.NodeTopics(t=1.1, publishes=[], subscribes=[])]
        call = run_of(*seen, *published, request, empty).call("first")
        assert help in failure_of(model.repeats_the_last_message.require, call).help


def test_a_field_that_was_changed_is_named_and_not_one_that_equals() -> None:
    published = [
        ev.BatteryPublished(t=t, message=BatteryState(percentage=0.9, voltage=33.5)) for t in (1.5, 2.0, 2.5)
    ]
    request = asked("first", "get_battery_status", t=3.0, request=GetBatteryStatus.Request())
    battery = BatteryState(percentage=0.9, voltage=48.0)
    wrong = answered("first", t=3.1, response=GetBatteryStatus.Response(available=True, battery=battery))
    model = exercise_module("battery_service", "model")
    failure = failure_of(
        model.repeats_the_last_message.require, run_of(*published, request, wrong).call("first")
    )
    assert failure.help.startswith("Other fields differ from the message (voltage): ")
