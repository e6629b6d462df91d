"""Style: one thread; a timer steps a state machine, and completes the future that the service callback awaits."""

import json
from enum import Enum, auto
from statistics import fmean

import rclpy
from geometry_msgs.msg import Vector3Stamped
from humanoid_interfaces.msg import RobotState
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy
from rclpy.task import Future
from sensor_msgs.msg import Imu
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Phase(Enum):
    IDLE = auto()
    ASKING = auto()
    COLLECTING = auto()


class Calibrator:
    """Not a node itself: it has one."""

    def __init__(self, node):
        self.node = node
        self.phase = Phase.IDLE
        self.state = None
        kept = QoSProfile(depth=1, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL)
        lossy = QoSProfile(depth=50, reliability=QoSReliabilityPolicy.BEST_EFFORT)
        self.publisher = node.create_publisher(Vector3Stamped, "imu_bias", kept)
        self.heartbeat = node.create_publisher(Empty, "heartbeat", 10)
        self.client = node.create_client(Trigger, "get_status")
        node.create_subscription(RobotState, "robot_state", self.take_state, kept)
        node.create_subscription(Imu, "imu", self.take_imu, lossy)
        node.create_timer(0.1, self.publish_heartbeat)
        node.create_timer(0.02, self.tick)
        # In the default group an unfinished callback would let nothing else run.
        group = ReentrantCallbackGroup()
        node.create_service(Trigger, "calibrate_imu", self.serve, callback_group=group)

    def publish_heartbeat(self):
        self.heartbeat.publish(Empty())

    def take_state(self, state):
        self.state = state
        if state.mode == RobotState.WALKING and self.phase is not Phase.IDLE:
            self.finish(False, "the robot has begun to walk")

    def take_imu(self, message):
        if self.phase is Phase.COLLECTING:
            self.samples.append(message.angular_velocity)

    async def serve(self, request, response):
        if self.state is None:
            response.message = "unknown state of the robot"
        elif self.state.mode == RobotState.WALKING:
            response.message = "walking"
        elif self.phase is not Phase.IDLE:
            response.message = "one calibration at a time"
        else:
            self.begin()
            response.success, response.message = await self.verdict
        return response

    def begin(self):
        self.verdict = Future()
        self.samples = []
        self.enter(Phase.ASKING, 2.0)
        self.answer = self.client.call_async(Trigger.Request())

    def enter(self, phase, seconds):
        self.phase = phase
        self.ends = self.node.get_clock().now() + Duration(seconds=seconds)

    def tick(self):
        over = self.phase is not Phase.IDLE and self.node.get_clock().now() >= self.ends
        if self.phase is Phase.ASKING and self.answer.done():
            self.enter(Phase.COLLECTING, 3.0)
        elif self.phase is Phase.ASKING and over:
            self.finish(False, "get_status was silent for two seconds")
        elif self.phase is Phase.COLLECTING and over:
            self.judge()

    def judge(self):
        if len(self.samples) < 100:
            return self.finish(False, f"too few samples: {len(self.samples)}")
        mean = {axis: fmean(getattr(sample, axis) for sample in self.samples) for axis in "xyz"}
        bias = Vector3Stamped()
        bias.header.frame_id = "imu_link"
        bias.header.stamp = self.node.get_clock().now().to_msg()
        for axis, value in mean.items():
            setattr(bias.vector, axis, value)
        self.publisher.publish(bias)
        self.finish(True, json.dumps({"bias": mean, "samples": len(self.samples)}))

    def finish(self, success, message):
        self.client.remove_pending_request(self.answer)
        self.phase = Phase.IDLE
        self.verdict.set_result((success, message))


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("calibrator")
    calibrator = Calibrator(node)
    executor = SingleThreadedExecutor()
    executor.add_node(calibrator.node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        node.get_logger().info("end of the calibrator")
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
