"""Offers a service of type Trigger that always says the same: `trigger_server.py forward refuses`, or `grants`."""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from std_srvs.srv import Trigger


def main() -> None:
    """Answer until Ctrl-C."""
    rclpy.init()
    _, service, answer = remove_ros_args()

    def on_request(_: Any, response: Any) -> Any:
        response.success = answer == "grants"
        response.message = f"{service} {answer}"
        return response

    node = Node("trigger_server")
    node.create_service(Trigger, service, on_request)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
