"""Style: a thread spins and notes what comes; the main thread polls what it noted, and Ctrl-C is its KeyboardInterrupt."""

import argparse
import math
import sys
import threading
import time

import rclpy
from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from rclpy.action import ActionClient
from rclpy.executors import MultiThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import BatteryState

PATIENCE = 5.0
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Seen:
    """What has come so far; written by the spinning thread, read by the main thread."""

    def __init__(self, node):
        self.percentage = None
        self.mode = RobotState.OFF
        self.feedback_at = 0.0
        self._log = node.get_logger()
        node.create_subscription(BatteryState, "battery_state", self._on_battery, LATCHED)
        node.create_subscription(RobotState, "robot_state", self._on_robot, LATCHED)

    def _on_battery(self, message):
        if 0.0 <= message.percentage <= 1.0:
            self.percentage = message.percentage
        else:
            self._log.warn("battery_state holds no percentage", once=True)

    def _on_robot(self, message):
        self.mode = message.mode

    def on_feedback(self, message):
        self.feedback_at = time.monotonic()

    def is_low(self):
        return self.percentage is not None and self.percentage < 0.2


def wait_until(condition, timeout=PATIENCE):
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


def fail(status, text):
    print(text, file=sys.stderr)
    return status


def guard(client, seen, goal):
    if not wait_until(lambda: seen.percentage is not None):
        return fail(1, "the battery is unknown")
    if not wait_until(lambda: client.server_is_ready() or seen.is_low()):
        return fail(1, "navigate_to_pose is not there")
    if seen.is_low():
        print(f"battery too low: {seen.percentage:.2f}")
        return 4
    sent = client.send_goal_async(goal, feedback_callback=seen.on_feedback)
    if not wait_until(sent.done):
        return fail(1, "the goal was not answered")
    handle = sent.result()
    if not handle.accepted:
        return fail(2, "the goal was rejected")
    result = handle.get_result_async()
    seen.feedback_at = time.monotonic()
    try:
        while not result.done() and not seen.is_low():
            if time.monotonic() - seen.feedback_at > PATIENCE:
                wait_until(handle.cancel_goal_async().done, 1.0)
                return fail(1, "the server has fallen silent")
            time.sleep(0.02)
    except KeyboardInterrupt:
        pass
    if not result.done():
        handle.cancel_goal_async()
        if not wait_until(result.done):
            print("cancelled; it has not ended in time")
            return 4
        if result.result().status == GoalStatus.STATUS_CANCELED:
            wait_until(lambda: seen.mode == RobotState.STANDING)
    return report(result.result())


def report(response):
    if response.status == GoalStatus.STATUS_SUCCEEDED:
        print("SUCCEEDED")
        return 0
    if response.status == GoalStatus.STATUS_CANCELED:
        print("CANCELED")
        return 4
    return fail(3, f"ABORTED ({response.result.error_code}): {response.result.error_msg}")


def main(args=None):
    parser = argparse.ArgumentParser()
    parser.add_argument("x", type=float)
    parser.add_argument("y", type=float)
    parser.add_argument("yaw", type=float, nargs="?", default=0.0)
    wanted = parser.parse_args(rclpy.utilities.remove_ros_args(args or sys.argv)[1:])
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("battery_guard")
    seen = Seen(node)
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    spinning = threading.Thread(target=executor.spin)
    spinning.start()
    goal = NavigateToPose.Goal()
    goal.pose.header.frame_id = "odom"
    goal.pose.pose.position.x = wanted.x
    goal.pose.pose.position.y = wanted.y
    goal.pose.pose.orientation.w = math.cos(0.5 * wanted.yaw)
    goal.pose.pose.orientation.z = math.sin(0.5 * wanted.yaw)
    try:
        return guard(ActionClient(node, NavigateToPose, "navigate_to_pose"), seen, goal)
    finally:
        executor.shutdown()
        spinning.join()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())
