"""The errors of a call or a goal name the fault in the student's node, as the self-check does."""

from __future__ import annotations

from textwrap import indent

import pytest
from kernels import CellError, Kernel

PROGRAM = """
import time
import rclpy
from rclpy.action import ActionServer
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from humanoid_interfaces.action import StandUp
from std_srvs.srv import SetBool, Trigger

class Status(Node):
    def __init__(self):
        super().__init__("status")
        self.state = None
        self.create_service(Trigger, "get_status", self.on_request)
        ActionServer(self, StandUp, "stand_up", self.execute)

    def on_request(self, request, response):
{callback}

    def execute(self, goal):
{execute}

def main():
    rclpy.init()
    node = Status()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass

main()
"""
ANSWERS = "response.message = 'up'\nreturn response"
SUCCEEDS = "goal.succeed()\nreturn StandUp.Result()"
CALL = "lab.call('get_status', Trigger)"
STAND_UP = "lab.send_goal('stand_up', StandUp, StandUp.Goal())"


def run(
    kernel: Kernel, cell: str, *, callback: str = ANSWERS, execute: str = SUCCEEDS, **changes: str
) -> str:
    """Run a cell beside a node with these bodies and changed texts; return what it printed, or its error."""
    program = PROGRAM.format(callback=indent(callback, " " * 8), execute=indent(execute, " " * 8))
    for old, new in changes.values():
        program = program.replace(old, new)
    (kernel.folder / "status.py").write_text(program, encoding="utf-8")
    kernel.run("from humanoid_interfaces.action import StandUp\nfrom std_srvs.srv import Trigger")
    try:
        return kernel.run(f"lab.run_node('status.py')\n{cell}")
    except CellError as error:
        return str(error)
    finally:
        kernel.run("lab.stop_nodes()")


@pytest.mark.parametrize(
    ("callback", "expected"),
    [
        (
            "response.message = 'up'",
            "status.py has ended with exit status 1: TypeError. Your service callback of get_status, on_request() in "
            "line 17 of status.py (`def on_request(self, request, response):`), returned nothing. End every branch "
            "with `return response`.",
        ),
        ("return True", "request, response):`), returned nothing, or something other than the response."),
        (
            "time.sleep(60)\nreturn response",
            "It was blocked in line 18 of status.py (`time.sleep(60)`), in on_request(). A callback may not wait",
        ),
        (
            "future = self.create_client(Trigger, 'get_status').call_async(request)\n"
            "rclpy.spin_until_future_complete(self, future)\nreturn response",
            "It was blocked in line 19 of status.py (`rclpy.spin_until_future_complete(self, future)`), in "
            "on_request(), which called spin_until_future_complete().",
        ),
        (
            "self.create_client(Trigger, 'get_status').call(request)\nreturn response",
            "It was blocked in line 18 of status.py (`self.create_client(Trigger, 'get_status').call(request)`), in "
            "on_request(), which called call().",
        ),
        (
            "response.message = self.state.mode\nreturn response",
            "A variable is still None, because no message has arrived yet: test `is None` before you use it. It was "
            "raised in line 18 of status.py (`response.message = self.state.mode`), in on_request().",
        ),
        ("response.success = 1\nreturn response", "The field success got a value of the wrong type"),
        (
            "raise ValueError('no')",
            "exit status 1: ValueError: no. An exception in a callback ends rclpy.spin()",
        ),
    ],
)
def test_a_fault_of_a_callback_is_named(kernel: Kernel, callback: str, expected: str) -> None:
    error = run(kernel, CALL, callback=callback)
    assert expected in error
    assert "no answer from get_status within 2 s" in error
    assert "rclpy/executors.py" not in error


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (("\nmain()", ""), "the file must call main() at its end"),
        (
            ('"get_status"', '"/get_status"'),
            "You offer /get_status, outside the namespace: remove the slash.",
        ),
        (
            ('"get_status"', '"get_state"'),
            "You offer get_state; the task requires exactly the name get_status.",
        ),
        (
            ('Trigger, "get', 'SetBool, "get'),
            "You offer get_status as std_srvs/srv/SetBool: give the service",
        ),
        (
            ("rclpy.spin(node)", "time.sleep(60)"),
            "No thread runs the node's callbacks: it was in line 29 of status.py (`time.sleep(60)`)",
        ),
    ],
)
def test_a_service_that_cannot_be_reached_is_explained(
    kernel: Kernel, change: tuple[str, str], expected: str
) -> None:
    assert expected in run(kernel, CALL, change=change)


def test_the_error_of_a_program_that_cannot_start_ends_with_its_last_line(kernel: Kernel) -> None:
    error = run(kernel, "", change=("self.state = None", "self.state = int('up')"))
    assert "status.py ended at once with exit status 1: " in error
    assert "(`self.state = int('up')`)" in error
    assert error.splitlines()[-1].startswith("ValueError: invalid literal")
    assert "site-packages" not in error


def test_an_execute_callback_that_raises_is_named_with_the_result(kernel: Kernel) -> None:
    printed = run(kernel, f"print({STAND_UP}.result())", execute="raise ValueError('no legs')")
    assert "execute raised an exception in line 22 of status.py (`raise ValueError('no legs')`)" in printed
    assert "ABORTED" in printed


def test_an_execute_callback_that_never_returns_is_named(kernel: Kernel) -> None:
    error = run(kernel, f"{STAND_UP}.result(timeout=1)", execute="time.sleep(60)\nreturn StandUp.Result()")
    assert "It was blocked in line 22 of status.py (`time.sleep(60)`), in execute()." in error


def test_a_wait_that_fails_says_what_the_node_did(kernel: Kernel) -> None:
    error = run(
        kernel,
        "lab.client.services.service_is_ready\ntry:\n    lab.call('get_status', Trigger)\nexcept lab.NoAnswerError:\n"
        "    lab.wait_until(lambda: False, timeout=0.2, what='the robot walks', seen=lambda: 'it stands')",
        callback="raise ValueError('no')",
    )
    assert "the robot walks: not within 0.2 s, but 'it stands'" in error
    assert "status.py has ended with exit status 1: ValueError: no." in error


def test_what_is_still_to_be_written_is_said_before_the_wait(kernel: Kernel) -> None:
    printed = kernel.run("""
from pathlib import Path
text = Path("adder.py").read_text()
Path("unwritten.py").write_text(text + "\\n\\ndef later():\\n    # YOUR CODE HERE\\n    return None\\n")
lab.run_node("unwritten.py").stop()
""")
    assert "unwritten.py is as the starter leaves it below `# YOUR CODE HERE` in line" in printed


def test_a_wait_that_fails_says_that_the_robot_lies(kernel: Kernel) -> None:
    kernel.run("from std_msgs.msg import Bool\nlab.start_robot()")
    try:
        error = run(
            kernel,
            "lab.publish('motor_power', Bool(data=False))\n"
            "lab.wait_until(lambda: lab.mode() == 'WALKING', timeout=4, what='the robot walks')",
        )
    finally:
        kernel.run("lab.stop_robot()")
    assert "the robot walks: not within 4 s. The robot lies: it fell " in error
    assert "lab.restart_robot()" in error
