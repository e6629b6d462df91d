"""Fault: swallows every exception and spins on, so Ctrl-C does not end it
Caught by: ends_cleanly
"""

import time

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
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


def main(args=None):
    rclpy.init(args=args)
    node = BatteryService()
    while True:
        try:
            rclpy.spin_once(node, timeout_sec=0.1)
        except BaseException as error:
            print(f"carrying on after {error!r}")
            time.sleep(0.1)


if __name__ == "__main__":
    main()
