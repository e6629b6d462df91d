"""The topics of the arms, the hands and the objects."""

from __future__ import annotations

from functools import partial

from geometry_msgs.msg import PoseStamped, WrenchStamped
from rclpy.node import Node
from rclpy.subscription import Subscription
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectory as JointTrajectoryMessage

from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.humanoid import Humanoid
from robot_sim.model.side import Side
from robot_sim.ros.messages import has_subscribers, set_fields
from robot_sim.state import HandPose, ObjectPose

WRENCH_RATE = 20.0  # Hz, as all rates below, in simulated time
HAND_RATE = 20.0
OBJECTS_RATE = 10.0


class ManipulationTopics:
    """The topic joint_trajectory and the topics of hands and objects, on the humanoid's node."""

    def __init__(self, node: Node, humanoid: Humanoid) -> None:
        self._node = node
        self._humanoid = humanoid
        self.trajectory: Subscription = node.create_subscription(
            JointTrajectoryMessage, "joint_trajectory", self._on_trajectory, 10
        )
        self.grippers: list[Subscription] = [
            node.create_subscription(
                Float64, f"{side.letter}_gripper/command", partial(self._on_opening, side), 10
            )
            for side in humanoid.hands
        ]
        self._wrenches = {
            side: node.create_publisher(WrenchStamped, f"{side.letter}_gripper/wrench", 10)
            for side in humanoid.hands
        }
        self._hands = {
            side: node.create_publisher(PoseStamped, f"{side.letter}_hand/pose", 10)
            for side in humanoid.hands
        }
        self._objects = {
            name: node.create_publisher(PoseStamped, f"objects/{name}/pose", 10)
            for name in humanoid.object_poses()
        }
        self.jobs = (
            (WRENCH_RATE, self._publish_wrenches),
            (HAND_RATE, self._publish_hands),
            (OBJECTS_RATE, self._publish_objects),
        )

    def _on_trajectory(self, message: JointTrajectoryMessage) -> None:
        try:
            if not self._humanoid.body.movable:
                raise ValueError(
                    "this robot has no joint that a trajectory can move; its walker moves them all"
                )
            self._humanoid.move_joints(_trajectory(message))
        except ValueError as error:
            self._node.get_logger().error(f"joint_trajectory ignored: {error}")

    def _on_opening(self, side: Side, message: Float64) -> None:
        try:
            self._humanoid.open_hand(side, message.data)
        except ValueError as error:
            self._node.get_logger().error(f"{side.letter}_gripper/command ignored: {error}")

    def _publish_wrenches(self) -> None:
        for side, publisher in self._wrenches.items():
            if has_subscribers(publisher):
                message = WrenchStamped()
                message.header.stamp = self._node.get_clock().now().to_msg()
                message.header.frame_id = f"{side.letter}_hand"
                message.wrench.force.y = self._humanoid.hands[side].grip_force
                publisher.publish(message)

    def _publish_hands(self) -> None:
        for side, publisher in self._hands.items():
            if has_subscribers(publisher):
                publisher.publish(self._stamped(self._humanoid.hands[side].pose))

    def _publish_objects(self) -> None:
        if not any(map(has_subscribers, self._objects.values())):
            return
        for name, pose in self._humanoid.object_poses().items():
            self._objects[name].publish(self._stamped(pose))

    def _stamped(self, pose: HandPose | ObjectPose) -> PoseStamped:
        message = PoseStamped()
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.header.frame_id = "odom"
        set_fields(message.pose.position, "xyz", pose.position)
        set_fields(message.pose.orientation, "xyzw", pose.quaternion)
        return message


def _trajectory(message: JointTrajectoryMessage) -> JointTrajectory:
    """Convert a message to the trajectory it describes, which starts on arrival.

    Raises:
        ValueError: the trajectory is not valid; the message says why.
    """
    waypoints = tuple(
        Waypoint(
            point.time_from_start.sec + point.time_from_start.nanosec * 1e-9,
            tuple(point.positions),
            tuple(point.velocities),
        )
        for point in message.points
    )
    return JointTrajectory(tuple(message.joint_names), waypoints)
