"""Style: composition, not inheritance; the elbow by bisection; a spin thread and a signal handler of its own."""

import math
import signal
import threading

import rclpy
from humanoid_interfaces.srv import ComputeIK
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions


class Arm:
    """Knows nothing of ROS."""

    def __init__(self, upper_arm, forearm):
        self.upper_arm, self.forearm = upper_arm, forearm

    def reach(self, bend):
        """How far the hand is from the shoulder; the more the elbow bends, the nearer."""
        return math.hypot(self.upper_arm + self.forearm * math.cos(bend), self.forearm * math.sin(bend))

    def bend_for(self, distance):
        straight, folded = 0.0, math.pi
        for _ in range(60):
            middle = (straight + folded) / 2.0
            if self.reach(middle) > distance:
                straight = middle
            else:
                folded = middle
        return (straight + folded) / 2.0

    def solve(self, x, y, elbow_up):
        """Shoulder and elbow, or None."""
        distance = math.hypot(x, y)
        if not self.reach(math.pi) <= distance <= self.reach(0.0):
            return None
        elbow = -self.bend_for(distance) if elbow_up else self.bend_for(distance)
        hand = math.atan2(self.forearm * math.sin(elbow), self.upper_arm + self.forearm * math.cos(elbow))
        return math.atan2(y, x) - hand, elbow


class Server:
    def __init__(self, node):
        self.node = node
        node.declare_parameter("upper_arm_length", 0.3)
        node.declare_parameter("forearm_length", 0.25)
        node.create_service(ComputeIK, "compute_ik", self.serve)

    def serve(self, request, response):
        target = request.target
        if target.header.frame_id != "shoulder":
            response.error_code = response.FRAME_TRANSFORM_FAILURE
            return response
        lengths = [
            parameter.value for parameter in self.node.get_parameters(["upper_arm_length", "forearm_length"])
        ]
        angles = Arm(*lengths).solve(target.point.x, target.point.y, request.elbow_up)
        if angles is None:
            response.error_code = response.NO_IK_SOLUTION
        else:
            response.error_code = response.SUCCESS
            response.shoulder, response.elbow = angles
        return response


def main(args=None):
    stop = threading.Event()
    signal.signal(signal.SIGINT, lambda number, frame: stop.set())
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("kinematics")
    Server(node)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    spinner = threading.Thread(target=executor.spin, daemon=True)
    spinner.start()
    stop.wait()
    executor.shutdown()
    spinner.join()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
