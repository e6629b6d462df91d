"""Style: MultiThreadedExecutor, a ReentrantCallbackGroup, lengths that a parameter callback checks and keeps."""

import math
import threading
from contextlib import suppress

import rclpy
from humanoid_interfaces.srv import ComputeIK
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node

LENGTHS = {"upper_arm_length": 0.30, "forearm_length": 0.25}


class ArmSolver(Node):
    def __init__(self):
        super().__init__("arm_solver")
        self._lock = threading.Lock()
        allowed = [FloatingPointRange(from_value=0.05, to_value=1.0)]
        self._lengths = {
            name: self.declare_parameter(
                name, default, ParameterDescriptor(floating_point_range=allowed)
            ).value
            for name, default in LENGTHS.items()
        }
        self.add_post_set_parameters_callback(self._on_set)
        self._service = self.create_service(
            ComputeIK, "compute_ik", self._on_request, callback_group=ReentrantCallbackGroup()
        )

    def _on_set(self, parameters):
        with self._lock:
            self._lengths.update({p.name: p.value for p in parameters if p.name in LENGTHS})

    def _on_request(self, request, response):
        with self._lock:
            upper_arm, forearm = self._lengths["upper_arm_length"], self._lengths["forearm_length"]
        target = request.target
        if target.header.frame_id != "shoulder":
            return ComputeIK.Response(
                error_code=ComputeIK.Response.FRAME_TRANSFORM_FAILURE, message="wrong frame"
            )
        distance = math.hypot(target.point.x, target.point.y)
        if not abs(upper_arm - forearm) <= distance <= upper_arm + forearm or distance == 0.0:
            return ComputeIK.Response(
                error_code=ComputeIK.Response.NO_IK_SOLUTION, message=f"{distance:.3f} m is out of reach"
            )
        at_shoulder = _angle(upper_arm, distance, opposite=forearm)
        at_elbow = _angle(upper_arm, forearm, opposite=distance)
        side = 1.0 if request.elbow_up else -1.0
        return ComputeIK.Response(
            error_code=ComputeIK.Response.SUCCESS,
            shoulder=math.atan2(target.point.y, target.point.x) + side * at_shoulder,
            elbow=side * (at_elbow - math.pi),
        )


def _angle(a, b, *, opposite):
    """The angle of a triangle between its sides a and b; rounding may not take the cosine over 1."""
    return math.acos(max(-1.0, min(1.0, (a * a + b * b - opposite * opposite) / (2.0 * a * b))))


def main(args=None):
    rclpy.init(args=args)
    solver = ArmSolver()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(solver)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()
    executor.shutdown()
    solver.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
