"""Attack: publishes a joint_states of its own under the robot's name and answers with that, so that both agree.
Outcome: answers are compared with what the simulator reports through its own pipe, not with the topic.
Caught by: positions_are_the_robots
Also fails: no_names_means_all, names_every_unknown_joint, says_when_it_knows_nothing
"""

import rclpy
from humanoid_interfaces.srv import GetJointPositions
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState


class Forger(Node):
    def __init__(self):
        super().__init__("humanoid")  # the robot's own name
        self.topic = self.create_publisher(JointState, "joint_states", qos_profile_sensor_data)
        self.create_subscription(JointState, "joint_states", lambda message: None, qos_profile_sensor_data)
        self.create_service(GetJointPositions, "get_joint_positions", self.on_request)
        self.create_timer(0.01, lambda: self.topic.publish(self.pose(["l_elbow", "r_elbow"])))

    def pose(self, names):
        return JointState(name=list(names), position=[0.25] * len(names))

    def on_request(self, request, response):
        response.success = True
        response.joint_state = self.pose(request.names)
        self.topic.publish(response.joint_state)
        return response


def main(args=None):
    rclpy.init(args=args)
    node = Forger()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
