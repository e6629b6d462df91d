"""Attack: writes over the arena's clock and starts itself again without it.
Outcome: the page is read-only and the others' time goes on; to a service that answers at once its own time does
not matter.
Passes: nothing it did not do
"""

import os
import sys

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

UNKNOWN = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"), float("nan"))


def leave_the_clock():
    """Start again without the library of the arena's clock, and with its page overwritten if it can be."""
    for name in [name for name in os.environ if "CLOCK" in name]:
        try:
            with open(os.environ[name], "r+b") as page:
                page.write(bytes(64))
        except OSError as error:
            print(f"{name}: {error}", flush=True)
    if os.environ.pop("LD_PRELOAD", None):
        os.execv(sys.executable, [sys.executable, *sys.argv])


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
    leave_the_clock()
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
