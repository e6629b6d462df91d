"""Fault: the number of the book's example instead of the robot's battery
Caught by: answers_with_the_last_message, says_when_it_knows_nothing
"""

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState


class BatteryService(Node):
    def __init__(self):
        super().__init__("battery_service")
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)

    def on_request(self, request, response):
        response.available = True
        response.battery.percentage = 0.85
        response.message = "Battery at 85%"
        return response


def main(args=None):
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
