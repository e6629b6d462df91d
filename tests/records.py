"""Makes records of runs by hand, and returns the failure that a check reports for one."""

from __future__ import annotations

from typing import Any

import pytest
from std_srvs.srv import Trigger

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from humanoid_interfaces.msg import RobotState

READY = (ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0))
PEERS = ev.RobotPeers(
    t=0.9, subscribers={"/robot/robot_state": 1}, publishers={"/robot/motor_power": 1, "/robot/cmd_vel": 0}
)
SPINNING = ('"/x/rclpy/executors.py", line 7 in spin_once', '"/tmp/work/status.py", line 50 in main')


def robot(t: float, *, motors: bool = True, mode: int = RobotState.STANDING, **more: float) -> Any:
    zeros = dict.fromkeys(("x", "y", "yaw", "speed", "turn_rate", "steps", "lag"), 0)
    numbers = {**zeros, "z": 0.6, "up": 1, **more}
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


def stack(*frames: str, t: float = 21.0) -> Any:
    lines = ["Fatal Python error: Aborted", "", "Current thread 0x01 (most recent call first):"]
    return ev.NodeStack(t=t, lines=[*lines, *(f"  File {frame}" for frame in frames)])
