"""Offers the action go_ahead, and ends each goal as told: `goal_server.py succeeds`, or `aborts`."""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.action import ActionServer
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from humanoid_interfaces.action import WalkTo

STEPS = 37
REASON = "somebody stands in the way"


def main() -> None:
    """Serve until Ctrl-C."""
    rclpy.init()
    how = remove_ros_args()[1]

    def execute(goal_handle: Any) -> Any:
        goal_handle.publish_feedback(WalkTo.Feedback(distance_remaining=0.25))
        if how == "succeeds":
            goal_handle.succeed()
            return WalkTo.Result(total_steps=STEPS)
        goal_handle.abort()
        return WalkTo.Result(total_steps=STEPS, error_code=WalkTo.Result.TIMEOUT, error_msg=REASON)

    node = Node("goal_server")
    server = ActionServer(node, WalkTo, "go_ahead", execute)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        server.destroy()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
