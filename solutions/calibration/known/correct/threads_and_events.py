"""Style: MultiThreadedExecutor; the callback blocks on events of threading, and what sets them has groups of its own."""

import threading
from contextlib import suppress

import numpy as np
import rclpy
from geometry_msgs.msg import Vector3, Vector3Stamped
from humanoid_interfaces.msg import RobotState
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Imu
from std_msgs.msg import Empty, Header
from std_srvs.srv import Trigger

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class CalibrationServer(Node):
    def __init__(self):
        super().__init__("calibration_server")
        self.running = threading.Lock()
        self.recording = threading.Lock()
        self.samples = None  # a list while a calibration collects
        self.mode = None
        self.walking = threading.Event()
        self.bias = self.create_publisher(Vector3Stamped, "imu_bias", LATCHED)
        self.beat = self.create_publisher(Empty, "heartbeat", 1)
        own = MutuallyExclusiveCallbackGroup
        self.create_subscription(RobotState, "robot_state", self.on_state, LATCHED, callback_group=own())
        self.create_subscription(Imu, "imu", self.on_imu, qos_profile_sensor_data, callback_group=own())
        self.create_timer(0.1, self.on_timer, callback_group=own())
        self.status = self.create_client(Trigger, "get_status", callback_group=own())
        self.create_service(
            Trigger, "calibrate_imu", self.on_calibrate, callback_group=ReentrantCallbackGroup()
        )

    def on_timer(self):
        self.beat.publish(Empty())

    def on_state(self, state):
        self.mode = state.mode
        if state.mode == RobotState.WALKING:
            self.walking.set()

    def on_imu(self, message):
        with self.recording:
            if self.samples is not None:
                rate = message.angular_velocity
                self.samples.append((rate.x, rate.y, rate.z))

    def on_calibrate(self, request, response):
        if not self.running.acquire(blocking=False):
            response.message = "busy with a calibration"
            return response
        try:
            response.success, response.message = self.calibrate()
        finally:
            self.running.release()
        return response

    def calibrate(self):
        self.walking.clear()
        if self.mode is None:
            return False, "the state of the robot is unknown"
        if self.mode == RobotState.WALKING:
            return False, "not while the robot is walking"
        if not self.status_answers():
            return False, "refused, since get_status does not answer"
        with self.recording:
            self.samples = []
        walked = self.walking.wait(3.0)
        with self.recording:
            samples, self.samples = self.samples, None
        if walked:
            return False, "stopped: the robot walks"
        if len(samples) < 100:
            return False, f"{len(samples)} samples are too few"
        mean = np.mean(samples, axis=0)
        header = Header(frame_id="imu_link", stamp=self.get_clock().now().to_msg())
        self.bias.publish(Vector3Stamped(header=header, vector=Vector3(x=mean[0], y=mean[1], z=mean[2])))
        return True, f"{len(samples)} samples: {mean[0]:+.6f} {mean[1]:+.6f} {mean[2]:+.6f}"

    def status_answers(self):
        answered = threading.Event()
        future = self.status.call_async(Trigger.Request())
        future.add_done_callback(lambda _future: answered.set())
        if answered.wait(2.0):
            return True
        self.status.remove_pending_request(future)
        return False


def main(args=None):
    rclpy.init(args=args)
    node = CalibrationServer()
    executor = MultiThreadedExecutor(num_threads=6)
    executor.add_node(node)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()
    executor.shutdown()
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
