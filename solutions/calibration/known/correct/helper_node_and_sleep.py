"""Style: functions; one thread spins, another sleeps, and a node of its own asks get_status with its own executor."""

import threading
import time

import rclpy
from geometry_msgs.msg import Vector3Stamped
from humanoid_interfaces.msg import RobotState
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Imu
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def make_asking():
    """Return a node, its executor, and a function that asks get_status, even from a callback of another node."""
    helper = rclpy.create_node("calibration_helper")
    executor = SingleThreadedExecutor()
    executor.add_node(helper)
    client = helper.create_client(Trigger, "get_status")

    def ask(seconds):
        until = time.monotonic() + seconds
        if not client.wait_for_service(timeout_sec=seconds):
            return False
        future = client.call_async(Trigger.Request())
        executor.spin_until_future_complete(future, timeout_sec=max(0.0, until - time.monotonic()))
        if not future.done():
            client.remove_pending_request(future)
        return future.done()

    return helper, executor, ask


def offer(node, ask):
    heard = {"modes": [], "rates": []}
    one_at_a_time = threading.Semaphore(1)
    publisher = node.create_publisher(Vector3Stamped, "imu_bias", LATCHED)
    heartbeat = node.create_publisher(Empty, "heartbeat", 10)
    modes, rates = heard["modes"], heard["rates"]

    def calibrate():
        if not modes or modes[-1] == RobotState.WALKING:
            return False, "the robot walks, or nothing is known of it"
        since = len(modes) - 1
        if not ask(2.0):
            return False, "nobody answers get_status"
        first = len(rates)
        time.sleep(3.0)
        taken = rates[first:]
        if RobotState.WALKING in modes[since:]:
            return False, "the robot walked meanwhile"
        if len(taken) < 100:
            return False, f"{len(taken)} samples instead of about 150"
        bias = Vector3Stamped()
        bias.header.frame_id = "imu_link"
        bias.header.stamp = node.get_clock().now().to_msg()
        for axis in "xyz":
            setattr(bias.vector, axis, sum(getattr(rate, axis) for rate in taken) / len(taken))
        publisher.publish(bias)
        v = bias.vector
        return True, f"({v.x:.4f}, {v.y:.4f}, {v.z:.4f}) rad/s; samples: {len(taken)}"

    def on_request(request, response):
        if one_at_a_time.acquire(blocking=False):
            response.success, response.message = calibrate()
            one_at_a_time.release()
        else:
            response.message = "somebody else is calibrating"
        return response

    node.create_subscription(RobotState, "robot_state", lambda state: modes.append(state.mode), LATCHED)
    node.create_subscription(
        Imu, "imu", lambda imu: rates.append(imu.angular_velocity), qos_profile_sensor_data
    )
    alone = MutuallyExclusiveCallbackGroup()
    node.create_timer(0.1, lambda: heartbeat.publish(Empty()), callback_group=alone)
    node.create_service(Trigger, "calibrate_imu", on_request, callback_group=ReentrantCallbackGroup())


def main(args=None):
    rclpy.init(args=args)
    helper, own_executor, ask = make_asking()
    node = rclpy.create_node("calibration")
    offer(node, ask)
    executor = MultiThreadedExecutor(4)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        own_executor.shutdown()
        node.destroy_node()
        helper.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
