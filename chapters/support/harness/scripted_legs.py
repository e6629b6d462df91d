"""A test double of the action server go_ahead, without a robot; it prints a line of JSON for each event of a goal.

    scripted_legs.py steady     publishes feedback until the goal ends
    scripted_legs.py silent     publishes three feedback messages, then none

The goal's position.x is its duration in s. After a cancel request the goal takes another second to end.
"""

from __future__ import annotations

import json
import time
from typing import Any

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from humanoid_interfaces.action import WalkTo

PERIOD = 0.1  # s between feedback messages
CANCEL_DURATION = 1.0  # s
MESSAGES_BEFORE_SILENCE = 3


def report(what: str) -> None:
    """Print an event for the check."""
    print(json.dumps({"what": what}), flush=True)


class ReportingActionServer(ActionServer):
    """Reports every cancel request, because rclpy calls the cancel callback only for the first one of a goal."""

    async def execute(self, taken_data: Any) -> None:
        """Report a cancel request, and handle it as usual."""
        if "cancel" in taken_data:
            report("cancel")
        await super().execute(taken_data)


class ScriptedLegs(Node):
    """Serves go_ahead, but moves no robot."""

    def __init__(self, how: str) -> None:
        super().__init__("legs")
        self._falls_silent = how == "silent"
        self.server = ReportingActionServer(
            self,
            WalkTo,
            "go_ahead",
            self._execute,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            result_timeout=60,
        )

    def _execute(self, goal_handle: Any) -> Any:
        report("accepted")
        until = time.monotonic() + goal_handle.request.target_pose.pose.position.x
        published = 0
        while time.monotonic() < until and rclpy.ok():
            if goal_handle.is_cancel_requested:
                time.sleep(CANCEL_DURATION)
                report("CANCELED")
                goal_handle.canceled()
                return WalkTo.Result()
            if not self._falls_silent or published < MESSAGES_BEFORE_SILENCE:
                goal_handle.publish_feedback(WalkTo.Feedback())
                published += 1
            time.sleep(PERIOD)
        report("SUCCEEDED")
        goal_handle.succeed()
        return WalkTo.Result()


def main() -> None:
    """Run the node until Ctrl-C."""
    rclpy.init()
    node = ScriptedLegs(remove_ros_args()[1])
    executor = MultiThreadedExecutor(num_threads=8)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        node.server.destroy()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
