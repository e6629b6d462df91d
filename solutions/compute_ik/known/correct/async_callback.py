"""Style: an async service callback, read-only parameters, the half-angle formula, angles of more than a turn."""

import math
from contextlib import contextmanager

import rclpy
from humanoid_interfaces.srv import ComputeIK
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

Codes = ComputeIK.Response


class InverseKinematics(Node):
    def __init__(self):
        super().__init__("inverse_kinematics")
        fixed = ParameterDescriptor(read_only=True, description="m")
        self.l1 = self.declare_parameter("upper_arm_length", 0.30, fixed).value
        self.l2 = self.declare_parameter("forearm_length", 0.25, fixed).value
        self.create_service(ComputeIK, "compute_ik", self.on_request)

    async def on_request(self, request, response):
        response.error_code = self.solve(request, response)
        response.message = {Codes.SUCCESS: "", Codes.NO_IK_SOLUTION: "out of reach"}.get(
            response.error_code, "not in frame shoulder"
        )
        return response

    def solve(self, request, response):
        if request.target.header.frame_id != "shoulder":
            return Codes.FRAME_TRANSFORM_FAILURE
        point = request.target.point
        squared = point.x**2 + point.y**2
        inside, outside = squared - (self.l1 - self.l2) ** 2, (self.l1 + self.l2) ** 2 - squared
        if not (inside >= 0.0 and outside >= 0.0):
            return Codes.NO_IK_SOLUTION
        half = math.atan2(math.sqrt(outside), math.sqrt(inside))
        elbow = 2.0 * (-half if request.elbow_up else half)
        reached = complex(self.l1) + self.l2 * complex(math.cos(elbow), math.sin(elbow))
        direction = complex(point.x, point.y) / reached if reached else 1.0
        response.shoulder = math.atan2(direction.imag, direction.real) + 2.0 * math.pi
        response.elbow = elbow % (2.0 * math.pi)
        return Codes.SUCCESS


@contextmanager
def running(node_class, args):
    rclpy.init(args=args)
    node = node_class()
    try:
        yield node
    except (KeyboardInterrupt, ExternalShutdownException):
        node.get_logger().info("good night")
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def main(args=None):
    with running(InverseKinematics, args) as node:
        rclpy.spin(node)


if __name__ == "__main__":
    main()
