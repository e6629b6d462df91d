"""Style: an async service callback, a context manager around init and shutdown, a latched subscription."""

from contextlib import contextmanager

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import BatteryState

LATCHED = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)


class BatteryService(Node):
    def __init__(self):
        super().__init__("battery_service")
        self.battery = None
        self.create_subscription(BatteryState, "battery_state", self.on_battery, LATCHED)
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)

    async def on_battery(self, battery):
        self.battery = battery

    async def on_request(self, request, response):
        if self.battery is None:
            nan = float("nan")
            battery = response.battery
            battery.percentage = battery.voltage = battery.current = battery.temperature = nan
            battery.charge = battery.capacity = battery.design_capacity = nan
            response.message = "unknown"
            return response
        response.available = True
        response.battery = self.battery
        return response


@contextmanager
def running(node_class, args):
    rclpy.init(args=args)
    node = node_class()
    try:
        yield node
    except (KeyboardInterrupt, ExternalShutdownException):
        node.get_logger().info("good night")
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def main(args=None):
    with running(BatteryService, args) as node:
        rclpy.spin(node)


if __name__ == "__main__":
    main()
