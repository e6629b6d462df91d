"""Fault: a synchronous call in a timer's callback: the answer waits for the thread that waits for it (M4)
Caught by: enables_then_asks
"""

import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger


class RobotController(Node):
    def __init__(self):
        super().__init__("robot_controller")
        self._enable = self.create_client(SetBool, "enable_motors")
        self._status = self.create_client(Trigger, "get_status")
        self._timer = self.create_timer(0.1, self._work)

    def _work(self):
        self._timer.cancel()
        if not self._enable.wait_for_service(timeout_sec=2.0) or not self._status.wait_for_service(
            timeout_sec=2.0
        ):
            print("no server", file=sys.stderr)
            raise SystemExit(1)
        self._enable.call(SetBool.Request(data=True))
        print(f"Robot status: {self._status.call(Trigger.Request()).message}")
        raise SystemExit(0)


def main(args=None):
    rclpy.init(args=args)
    controller = RobotController()
    try:
        rclpy.spin(controller)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        controller.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
