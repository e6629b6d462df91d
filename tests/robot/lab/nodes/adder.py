"""Adds; sleeps first when a is negative, crashes when b is negative, and forgets to return the sum 13."""

import sys
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from humanoid_interfaces.srv import AddTwoInts


class Adder(Node):
    def __init__(self, offset):
        super().__init__("adder")
        self.offset = offset
        self.create_service(AddTwoInts, "add", self.add)

    def add(self, request, response):
        if request.a < 0:
            time.sleep(-request.a)
        if request.b < 0:
            raise ValueError("b is negative")
        response.sum = request.a + request.b + self.offset
        print(f"answered {response.sum}")
        return None if response.sum == 13 else response


rclpy.init()
node = Adder(int(sys.argv[1]) if sys.argv[1:2] != ["--ros-args"] else 0)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    node.destroy_node()
    rclpy.try_shutdown()
