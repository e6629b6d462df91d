"""Style: functions and closures over a dictionary of positions, no class; spin_once in a loop; failures first."""

import sys

import rclpy
from humanoid_interfaces.srv import GetJointPositions
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


def add_service(node):
    positions = {}

    def remember(message):
        positions.update(zip(message.name, message.position))

    def answer(request, response):
        unknown = set(request.names) - set(positions)
        if not positions:
            response.message = "waiting for joint_states"
        elif unknown:
            response.message = f"no such joints: {sorted(unknown)}; there are {sorted(positions)}"
        else:
            response.success = True
            for name in request.names or sorted(positions):
                response.joint_state.name.append(name)
                response.joint_state.position.append(positions[name])
        return response

    node.create_subscription(JointState, "joint_states", remember, BEST_EFFORT)
    node.create_service(GetJointPositions, "get_joint_positions", answer)


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("joints")
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
