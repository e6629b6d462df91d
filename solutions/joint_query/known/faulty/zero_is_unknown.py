"""Fault: takes a joint at exactly 0.0 for one that it does not know
Caught by: answers_in_any_posture
"""

import rclpy
from humanoid_interfaces.srv import GetJointPositions
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState


class JointQuery(Node):
    def __init__(self):
        super().__init__("joint_query")
        self.last = None
        self.create_subscription(JointState, "joint_states", self.on_joint_states, qos_profile_sensor_data)
        self.create_service(GetJointPositions, "get_joint_positions", self.on_request)

    def on_joint_states(self, message):
        self.last = message

    def on_request(self, request, response):
        if self.last is None:
            response.message = "no joint_states has arrived yet"
            return response
        positions = dict(zip(self.last.name, self.last.position))
        names = request.names or self.last.name
        unknown = [name for name in names if not positions.get(name)]
        if unknown:
            response.message = f"unknown joints: {', '.join(unknown)}"
            return response
        response.success = True
        response.joint_state.header = self.last.header
        response.joint_state.name = list(names)
        response.joint_state.position = [positions[name] for name in names]
        return response


def main(args=None):
    rclpy.init(args=args)
    node = JointQuery()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
