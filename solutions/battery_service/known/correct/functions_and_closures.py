"""Style: functions and closures over a dictionary, no class; an EventsExecutor."""

import math
import sys

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.experimental import EventsExecutor
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import BatteryState


def unknown_battery():
    battery = BatteryState()
    for field in ("percentage", "voltage", "current", "temperature", "charge", "capacity", "design_capacity"):
        setattr(battery, field, math.nan)
    return battery


def add_service(node):
    seen = {}

    def remember(message):
        seen["battery"] = message

    def answer(_request, response):
        response.available = "battery" in seen
        response.battery = seen.get("battery", unknown_battery())
        response.message = "" if response.available else "waiting for battery_state"
        return response

    node.create_subscription(BatteryState, "battery_state", remember, qos_profile_sensor_data)
    node.create_service(GetBatteryStatus, "get_battery_status", answer)


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("battery")
    add_service(node)
    executor = EventsExecutor()
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
