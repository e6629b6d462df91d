"""Attack: sixteen processes, each in a session of its own, wake up at the same moment and keep the processors busy for a while, so that
the robot is late and a server that keeps the first battery_state is not judged.
Outcome: they yield to robot and grader when they wake up; how many processors were busy at once is known, and is the failure where it hurt.
Caught by: answers_with_the_last_message
Also fails: server_appears, says_when_it_knows_nothing, ends_cleanly
"""

import os
import time

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

UNKNOWN = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"), float("nan"))


def attack():
    for _ in range(16):
        if os.fork() == 0:
            os.setsid()
            while True:
                time.sleep(1.0 - time.time() % 1.0)
                end = time.process_time() + 0.08
                while time.process_time() < end:
                    pass


class BatteryService(Node):
    def __init__(self):
        super().__init__("battery_service")
        self.last = None
        self.create_subscription(BatteryState, "battery_state", self.on_battery_state, 10)
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)

    def on_battery_state(self, message):
        if self.last is None:
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
    attack()
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
