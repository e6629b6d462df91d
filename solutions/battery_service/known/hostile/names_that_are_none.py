"""Attack: is sound but for a second node, whose name is changed in its own memory into one that ROS forbids, so that all
who list the nodes stumble over it.
Outcome: the grader asks by the names of services; the odd name is seen at the end, and is the failure.
Caught by: server_appears
"""

import os
import re
import time

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

LARGE = 2**26  # bytes
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


def rename_in_memory(name, other):
    """Write `other` over every copy of `name` in the heap of this process."""
    with open("/proc/self/maps") as maps:
        areas = [line.split()[0].split("-") for line in maps if " rw-p " in line and "stack" not in line]
    memory = os.open("/proc/self/mem", os.O_RDWR)
    places = []
    for start, end in ((int(start, 16), int(end, 16)) for start, end in areas):
        if end - start < LARGE:
            data = os.pread(memory, end - start, start)
            places += [start + found.start() for found in re.finditer(name, data)]
    for place in places:
        if os.pread(memory, len(name), place) == name:
            os.pwrite(memory, other, place)


def main(args=None):
    rclpy.init(args=args)
    odd = [rclpy.create_node("no_name"), rclpy.create_node("another")]
    rename_in_memory(b"no" + b"_name", b"no/name")
    odd.append(rclpy.create_node("one_more"))  # the list of all nodes is sent anew
    time.sleep(1.0)  # while the service is still missing, its seekers look at every node
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
