"""Style: async callbacks, an exception of its own turned into a response, a context manager around init and shutdown."""

from contextlib import contextmanager

import rclpy
from humanoid_interfaces.srv import GetJointPositions
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState


class CannotAnswer(Exception):
    pass


def select(last, names):
    """Return the part of a message that belongs to the joints of these names; no names: all of them."""
    if last is None:
        raise CannotAnswer("joint_states has not come yet")
    places = {name: place for place, name in enumerate(last.name)}
    if unknown := [name for name in names if name not in places]:
        raise CannotAnswer("the robot has no " + " and no ".join(map(repr, unknown)))
    chosen = [places[name] for name in names or last.name]
    return JointState(
        header=last.header,
        name=[last.name[place] for place in chosen],
        position=[last.position[place] for place in chosen],
    )


class JointQuery(Node):
    def __init__(self):
        super().__init__("joint_query")
        self.last = None
        self.create_subscription(JointState, "joint_states", self.on_joints, qos_profile_sensor_data)
        self.create_service(GetJointPositions, "get_joint_positions", self.on_request)

    async def on_joints(self, message):
        self.last = message

    async def on_request(self, request, response):
        try:
            response.joint_state = select(self.last, request.names)
            response.success = True
        except CannotAnswer as error:
            response.message = str(error)
        return response


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
    with running(JointQuery, args) as node:
        rclpy.spin(node)


if __name__ == "__main__":
    main()
