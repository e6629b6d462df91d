"""Style: one thread; an async callback awaits futures, which an answer or a timer completes."""

import rclpy
from geometry_msgs.msg import Vector3Stamped
from humanoid_interfaces.msg import RobotState
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.task import Future
from sensor_msgs.msg import Imu
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
HEARTBEAT_PERIOD = 0.1  # s
ASKING = 2.0  # s, at most, for get_status
COLLECTING = 3.0  # s
FEWEST_SAMPLES = 100


def mean_of(samples):
    """Return the means of x, y and z over a list of vectors."""
    return [sum(getattr(sample, axis) for sample in samples) / len(samples) for axis in "xyz"]


class Calibration(Node):
    def __init__(self):
        super().__init__("calibration")
        self._state = None  # the last RobotState
        self._busy = False  # whether a calibration runs
        self._walked = False  # whether the robot has walked since it began
        self._samples = []  # angular velocities (rad/s) of the calibration that runs
        # A callback that awaits, and what completes its futures, must be let in at the same time.
        self._together = ReentrantCallbackGroup()
        self._imu_bias = self.create_publisher(Vector3Stamped, "imu_bias", LATCHED)
        self._heartbeat = self.create_publisher(Empty, "heartbeat", 10)
        self._get_status = self.create_client(Trigger, "get_status", callback_group=self._together)
        self.create_subscription(RobotState, "robot_state", self._on_robot_state, LATCHED)
        self.create_subscription(Imu, "imu", self._on_imu, qos_profile_sensor_data)
        self.create_timer(HEARTBEAT_PERIOD, lambda: self._heartbeat.publish(Empty()))
        self.create_service(Trigger, "calibrate_imu", self._on_request, callback_group=self._together)

    def _on_robot_state(self, message):
        self._state = message
        if message.mode == RobotState.WALKING:
            self._walked = True

    def _on_imu(self, message):
        if self._busy:
            self._samples.append(message.angular_velocity)

    async def _on_request(self, request, response):
        reason = self._why_not_now()
        if reason:
            response.message = reason
            return response
        self._busy, self._walked = True, False
        try:
            response.success, response.message = await self._calibrate()
        finally:
            self._busy = False
        return response

    def _why_not_now(self):
        """Return why no calibration can begin, "" if one can."""
        if self._busy:
            return "another calibration runs"
        if self._state is None:
            return "no robot_state has arrived yet: does the robot stand?"
        if self._state.mode == RobotState.WALKING:
            return "the robot walks: stop it first"
        return ""

    async def _calibrate(self):
        """Return whether it worked, and the answer in words."""
        if await self._status_in_time() is None:
            return False, f"get_status gave no answer within {ASKING:g} s"
        self._samples = []
        await self._pause(COLLECTING)
        samples = self._samples
        if self._walked:
            return False, "the robot began to walk"
        if len(samples) < FEWEST_SAMPLES:
            return False, f"only {len(samples)} samples of the imu arrived"
        x, y, z = mean_of(samples)
        self._publish_bias(x, y, z)
        return True, f"bias x {x:.5f}, y {y:.5f}, z {z:.5f} rad/s, the mean of {len(samples)} samples"

    async def _status_in_time(self):
        """Return what get_status answers, None if that takes too long."""
        future = self._get_status.call_async(Trigger.Request())
        timer = self.create_timer(ASKING, lambda: future.set_result(None), callback_group=self._together)
        answer = await future
        self.destroy_timer(timer)
        self._get_status.remove_pending_request(future)
        return answer

    async def _pause(self, duration):
        """Let so many seconds pass while the node goes on."""
        over = Future()
        timer = self.create_timer(duration, lambda: over.set_result(None), callback_group=self._together)
        await over
        self.destroy_timer(timer)

    def _publish_bias(self, x, y, z):
        bias = Vector3Stamped()
        bias.header.stamp = self.get_clock().now().to_msg()
        bias.header.frame_id = "imu_link"
        bias.vector.x, bias.vector.y, bias.vector.z = x, y, z
        self._imu_bias.publish(bias)


def main(args=None):
    rclpy.init(args=args)
    node = Calibration()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
