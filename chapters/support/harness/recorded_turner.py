"""Runs a student's turn server, and prints the calls whose order decides how a goal ends.

recorded_turner.py cancellable_turn.py

Each line is JSON: the call (`stop` is a Twist of zeros on cmd_vel, the others are methods), whether the robot was
walking at that moment, and how many steps it had made for the goal.
"""

from __future__ import annotations

import json
import os
import runpy
import sys
from importlib import import_module
from typing import Any

from geometry_msgs.msg import Twist
from rclpy.action.server import ServerGoalHandle

from humanoid_interfaces.msg import RobotState

TERMINAL_CALLS = ("succeed", "abort", "canceled")


class CallRecorder:
    """Replaces methods of the chapter's class Turner and of rclpy's goal handles by ones that print their calls."""

    def __init__(self, turner: type) -> None:
        self._node: Any = None
        self._first_step = 0
        self._replace(turner, "__init__", after=self._remember_node)
        self._replace(turner, "turn", before=self._remember_first_step)
        self._replace(turner, "result", before=lambda *_: self._print("result"))
        for name in TERMINAL_CALLS:
            self._replace(ServerGoalHandle, name, before=lambda *_, name=name: self._print(name))

    def _replace(self, owner: type, name: str, *, before: Any = None, after: Any = None) -> None:
        method = getattr(owner, name)

        def replacement(*arguments: Any, **options: Any) -> Any:
            if before:
                before(*arguments)
            returned = method(*arguments, **options)
            if after:
                after(*arguments)
            return returned

        setattr(owner, name, replacement)

    def _remember_node(self, node: Any) -> None:
        self._node = node
        publish = node.cmd_vel.publish

        def publish_and_print(command: Any) -> None:
            if command == Twist():
                self._print("stop")
            publish(command)

        node.cmd_vel.publish = publish_and_print

    def _remember_first_step(self, _node: Any, _goal_handle: Any, first_step: int) -> None:
        self._first_step = first_step

    def _print(self, call: str) -> None:
        state = self._node.state
        walking, steps = state.mode == RobotState.WALKING, state.steps - self._first_step
        print(json.dumps({"call": call, "walking": walking, "steps": steps}), flush=True)


def main() -> None:
    """Run the student's file, which the argument names."""
    sys.path.insert(0, os.getcwd())
    CallRecorder(import_module("turner").Turner)
    runpy.run_path(sys.argv[1], run_name="__main__")


if __name__ == "__main__":
    main()
