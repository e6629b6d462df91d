"""Style: MultiThreadedExecutor, a ReentrantCallbackGroup, a lock around the last message, positions by index."""

import threading
from contextlib import suppress

import rclpy
from humanoid_interfaces.srv import GetJointPositions
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState


class JointMonitor(Node):
    def __init__(self):
        super().__init__("joint_monitor")
        group = ReentrantCallbackGroup()
        self._lock = threading.Lock()
        self._joints = JointState()
        self.create_subscription(
            JointState, "joint_states", self._on_joints, qos_profile_sensor_data, callback_group=group
        )
        self.create_service(
            GetJointPositions, "get_joint_positions", self._on_request, callback_group=group
        )

    def _on_joints(self, message):
        with self._lock:
            self._joints = message

    def _on_request(self, request, response):
        with self._lock:
            joints = self._joints
        if not joints.name:
            response.message = "the joints have not been heard of"
            return response
        if not request.names:
            response.success, response.joint_state = True, joints
            return response
        unknown = []
        for name in request.names:
            try:
                index = joints.name.index(name)
            except ValueError:
                unknown.append(name)
                continue
            response.joint_state.name.append(name)
            response.joint_state.position.append(joints.position[index])
            response.joint_state.velocity.append(joints.velocity[index])
            response.joint_state.effort.append(joints.effort[index])
        if unknown:
            response.joint_state = JointState()
            response.message = "unknown: " + " ".join(unknown)
        response.success = not unknown
        return response


def main(args=None):
    rclpy.init(args=args)
    monitor = JointMonitor()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(monitor)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()
    executor.shutdown()
    monitor.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
