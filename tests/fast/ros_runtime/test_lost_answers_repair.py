"""The repair of the ActionClient: a quick response is not lost if one thread sends and another one spins."""

import json
from types import SimpleNamespace

import pytest
from rclpy.action import client as installed
from rclpy_process import run_scenario

from ros_runtime.workarounds.rclpy_repairs import lost_answers

AFFECTED = lost_answers.needs_repair(installed) or hasattr(
    installed.ActionClient.send_goal_async, "__wrapped__"
)


def answered(repairs):
    done = run_scenario("goal_scenarios.py", "a_goal_is_sent_cancelled_and_asked_for_its_result", repairs)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_responses_are_received_while_the_sender_has_no_processor():
    assert answered("on") == {"goal": True, "cancel": True, "result": True}


@pytest.mark.skipif(not AFFECTED, reason="this rclpy does not have the fault")
def test_without_the_repair_responses_are_lost():
    assert answered("off") == {"goal": False}


def test_a_client_that_holds_a_lock_is_not_changed():
    class Mended:
        def send_goal_async(self):
            with self._lock:
                pass

    assert not lost_answers.needs_repair(SimpleNamespace(ActionClient=Mended))
