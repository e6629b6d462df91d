"""Attack: right answers with a message of forty million characters, more than an arena's report may have.
Outcome: an answer is measured before it is unpacked; this one is not read, and its size is the failure.
Caught by: answers_with_the_last_message
Also fails: server_appears, says_when_it_knows_nothing, ends_cleanly
"""

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
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
        response.message = "x" * 40_000_000
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
