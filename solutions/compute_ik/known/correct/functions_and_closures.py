"""Style: functions and closures, no class; the elbow as the point where two circles meet; spin_once in a loop."""

import math
import sys

import rclpy
from humanoid_interfaces.srv import ComputeIK
from rclpy.executors import ExternalShutdownException

CODES = ComputeIK.Response


def find_elbow(x, y, upper_arm, forearm, above):
    """The point upper_arm away from the shoulder and forearm away from (x, y), or None."""
    distance = math.hypot(x, y)
    if not math.isfinite(distance) or distance == 0.0:
        return None
    along = (distance**2 + upper_arm**2 - forearm**2) / (2.0 * distance)
    if abs(along) > upper_arm:
        return None
    aside = math.sqrt(upper_arm**2 - along**2)
    ux, uy = x / distance, y / distance
    left = (ux * along - uy * aside, uy * along + ux * aside)
    right = (ux * along + uy * aside, uy * along - ux * aside)
    higher, lower = (left, right) if left[1] >= right[1] else (right, left)
    return higher if above else lower


def add_service(node):
    node.declare_parameters("", [("upper_arm_length", 0.3), ("forearm_length", 0.25)])

    def length(name):
        return node.get_parameter(name).get_parameter_value().double_value

    def answer(request, response):
        if request.target.header.frame_id != "shoulder":
            response.error_code = CODES.FRAME_TRANSFORM_FAILURE
            response.message = "give the target in frame shoulder"
            return response
        x, y = request.target.point.x, request.target.point.y
        elbow = find_elbow(x, y, length("upper_arm_length"), length("forearm_length"), request.elbow_up)
        if elbow is None:
            response.error_code = CODES.NO_IK_SOLUTION
            return response
        response.error_code = CODES.SUCCESS
        response.shoulder = math.atan2(elbow[1], elbow[0])
        response.elbow = math.atan2(y - elbow[1], x - elbow[0]) - response.shoulder
        return response

    node.create_service(ComputeIK, "compute_ik", answer)


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("ik")
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
