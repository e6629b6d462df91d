"""Attack: keeps the processors busy with children that live for 30 ms and that nobody waits for, so that their time is in no account, the
machine is too busy to judge a server that keeps the first battery_state for ever.
Outcome: they yield to robot and grader, and none goes uncounted; what came late by them is the failure.
Caught by: answers_with_the_last_message
Also fails: server_appears, says_when_it_knows_nothing, ends_cleanly
"""

import os
import signal
import time

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

NAN = float("nan")


def attack():
    if os.fork() == 0:
        try:
            signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # the kernel buries them, and counts nothing
        except OSError:
            pass
        while True:
            try:
                if os.fork() == 0:
                    if os.fork() == 0:
                        end = time.monotonic() + 0.03
                        while time.monotonic() < end:
                            pass
                    os._exit(0)
            except OSError:
                time.sleep(0.001)


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
            response.battery = BatteryState(percentage=NAN, voltage=NAN, current=NAN)
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
