"""Style: MultiThreadedExecutor, a ReentrantCallbackGroup and a lock around the last message."""

import threading
from contextlib import suppress
from copy import deepcopy

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import BatteryState


def nothing_measured():
    names = "voltage temperature current charge capacity design_capacity percentage".split()
    return BatteryState(**{name: float("nan") for name in names})


class BatteryMonitor(Node):
    def __init__(self):
        super().__init__("battery_monitor")
        group = ReentrantCallbackGroup()
        self._lock = threading.Lock()
        self._battery = nothing_measured()
        self._known = False
        self._subscription = self.create_subscription(
            BatteryState, "battery_state", self._on_battery, 1, callback_group=group
        )
        self._service = self.create_service(
            GetBatteryStatus, "get_battery_status", self._on_request, callback_group=group
        )

    def _on_battery(self, message):
        with self._lock:
            self._battery = message
            self._known = True

    def _on_request(self, request, response):
        with self._lock:
            response.available = self._known
            response.battery = deepcopy(self._battery)
        if not response.available:
            response.message = "the battery has not been heard of"
        return response


def main(args=None):
    rclpy.init(args=args)
    monitor = BatteryMonitor()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(monitor)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()
    executor.shutdown()
    monitor.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
