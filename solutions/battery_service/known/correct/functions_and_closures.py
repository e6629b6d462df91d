"""Style: functions and closures over a dictionary, no class; spin_once in a loop that looks at rclpy.ok()."""

import math
import sys

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
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
    try:
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.5)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
