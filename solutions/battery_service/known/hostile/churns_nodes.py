"""Attack: a sound server beside which nodes come and go, hundreds a second.
Outcome: nobody asks for nodes by name while it does; it serves as ever.
Passes: nothing it did not do
"""

import os
from itertools import count

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

UNKNOWN = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"), float("nan"))


class BatteryService(Node):
    def __init__(self):
        super().__init__("battery_service")
        self.last = None
        self.create_subscription(BatteryState, "battery_state", self.on_battery_state, 10)
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)

    def on_battery_state(self, message):
        self.last = message

    def on_request(self, request, response):
        if self.last is None:
            response.available = False
            response.message = "no battery_state has arrived yet"
            response.battery = BatteryState(**UNKNOWN)
        else:
            response.available = True
            response.message = f"{self.last.percentage:.0%}"
            response.battery = self.last
        return response


def churn():
    """In a process of its own, without parameters or logs: a node is then a name in a list, and nothing else."""
    if os.fork():
        return
    rclpy.init()
    context = rclpy.get_default_context().handle
    for number in count():
        with context:
            node = rclpy_implementation.Node(f"fly_{number}", "/robot", context, None, False, False)
        node.destroy_when_not_in_use()


def main(args=None):
    churn()
    rclpy.init(args=args)
    node = BatteryService()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
