"""Fault: notes once a second at which place each joint stands in the messages
Caught by: looks_joints_up_by_name
"""

import time

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
        self.places, self.renewed = {}, -1.0
        self.create_subscription(JointState, "joint_states", self.on_joint_states, qos_profile_sensor_data)
        self.create_service(GetJointPositions, "get_joint_positions", self.on_request)

    def on_joint_states(self, message):
        self.last = message
        now = time.monotonic()
        if now - self.renewed >= 1.0:
            self.places, self.renewed = {name: place for place, name in enumerate(message.name)}, now

    def on_request(self, request, response):
        if self.last is None:
            response.message = "no joint_states has arrived yet"
            return response
        positions = {name: self.last.position[place] for name, place in self.places.items()}
        names = request.names or self.last.name
        unknown = [name for name in names if name not in positions]
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
