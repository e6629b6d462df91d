"""Plays go_ahead without a robot, and prints a line of JSON for each thing that happens to a goal.

    played_legs.py steady     feedback all the time
    played_legs.py mute       three messages of feedback, and then none

A goal's position.x is how long it works, in s. After a cancel it goes on for a second.
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

PERIOD = 0.1  # s
AFTER_A_CANCEL = 1.0  # s
BEFORE_MUTE = 3  # messages


def tell(what: str) -> None:
    """Print what happens now, for the check."""
    print(json.dumps({"what": what}), flush=True)


class TellingServer(ActionServer):
    """Tells of each cancel request; a cancel callback is not called again for a goal that is being cancelled."""

    async def execute(self, taken_data: Any) -> None:
        """Tell, and serve what has arrived."""
        if "cancel" in taken_data:
            tell("cancel")
        await super().execute(taken_data)


class PlayedLegs(Node):
    """Offers go_ahead, and moves nothing."""

    def __init__(self, how: str) -> None:
        super().__init__("legs")
        self._is_mute = how == "mute"
        self.server = TellingServer(
            self,
            WalkTo,
            "go_ahead",
            self._execute,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            result_timeout=60,
        )

    def _execute(self, goal_handle: Any) -> Any:
        tell("accepted")
        until = time.monotonic() + goal_handle.request.target_pose.pose.position.x
        told = 0
        while time.monotonic() < until and rclpy.ok():
            if goal_handle.is_cancel_requested:
                time.sleep(AFTER_A_CANCEL)
                tell("CANCELED")
                goal_handle.canceled()
                return WalkTo.Result()
            if not self._is_mute or told < BEFORE_MUTE:
                goal_handle.publish_feedback(WalkTo.Feedback())
                told += 1
            time.sleep(PERIOD)
        tell("SUCCEEDED")
        goal_handle.succeed()
        return WalkTo.Result()


def main() -> None:
    """Serve until Ctrl-C."""
    rclpy.init()
    node = PlayedLegs(remove_ros_args()[1])
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
