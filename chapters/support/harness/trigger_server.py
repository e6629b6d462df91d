"""Offers a service of type Trigger that refuses, grants or ignores each request.

trigger_server.py forward refuses
"""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future
from rclpy.utilities import remove_ros_args
from std_srvs.srv import Trigger


def main() -> None:
    """Run the node until Ctrl-C."""
    rclpy.init()
    _, service, answer = remove_ros_args()

    async def on_request(_: Any, response: Any) -> Any:
        if answer == "ignores":
            print("ignored", flush=True)
            await Future()  # never completed, so no response is sent
        response.success = answer == "grants"
        response.message = f"{service} {answer}"
        return response

    node = Node("trigger_server")
    node.create_service(Trigger, service, on_request, callback_group=ReentrantCallbackGroup())
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
