"""Fault: offers a std_srvs/Trigger with the positions as text
Caught by: server_appears
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger


class JointQuery(Node):
    def __init__(self):
        super().__init__("joint_query")
        self.last = None
        self.create_subscription(JointState, "joint_states", self.on_joint_states, qos_profile_sensor_data)
        self.create_service(Trigger, "get_joint_positions", self.on_request)

    def on_joint_states(self, message):
        self.last = message

    def on_request(self, request, response):
        if self.last is None:
            response.message = "no joint_states has arrived yet"
            return response
        response.success = True
        response.message = ", ".join(
            f"{name} {position:.3f}" for name, position in zip(self.last.name, self.last.position)
        )
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
