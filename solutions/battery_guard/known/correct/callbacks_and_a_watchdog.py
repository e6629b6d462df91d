"""Style: nothing waits; callbacks follow goal, battery and robot, a timer watches the clock, and a future ends the spinning."""

import argparse
import math
import signal
import sys

import rclpy
from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from sensor_msgs.msg import BatteryState

PATIENCE = 5.0  # s
LIMIT = 0.20
LATCHED = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)


class Guard(Node):
    def __init__(self, goal):
        super().__init__("battery_guard")
        self.over = Future()  # (exit status, line)
        self.interrupted = False
        self._goal = goal
        self._handle = None
        self._percentage = math.nan
        self._stands = False
        self._warned = False
        self._client = ActionClient(self, NavigateToPose, "navigate_to_pose")
        self.create_subscription(BatteryState, "battery_state", self._on_battery, LATCHED)
        self.create_subscription(RobotState, "robot_state", self._on_state, LATCHED)
        self._enter("waiting for battery_state")
        self.create_timer(0.05, self._watch)

    def _now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def _enter(self, state):
        self._state = state
        self._deadline = self._now() + PATIENCE

    def _end(self, status, line):
        if not self.over.done():
            self.over.set_result((status, line))

    def _on_battery(self, message):
        level = message.percentage
        if math.isnan(level) or level < 0.0 or level > 1.0:
            if not self._warned:
                self._warned = True
                print(f"warning: battery_state says {level}, which is ignored", file=sys.stderr)
            return
        self._percentage = level
        if self._state == "waiting for battery_state":
            self._enter("waiting for navigate_to_pose")
        self._look_at_the_battery()

    def _look_at_the_battery(self):
        if not self._percentage < LIMIT:
            return
        if self._state == "waiting for navigate_to_pose":
            self._end(4, f"battery at {100 * self._percentage:.1f} %: no goal was sent")
        elif self._state == "on the way":
            self._cancel("stopping")

    def _on_state(self, message):
        self._stands = message.mode == RobotState.STANDING
        if self._state == "waiting for the robot to stand" and self._stands:
            self._end(4, "CANCELED, and the robot stands")

    def _watch(self):
        if self._state == "waiting for navigate_to_pose" and self._client.server_is_ready():
            self._enter("waiting for the answer")
            self._client.send_goal_async(self._goal, self._on_feedback).add_done_callback(self._on_answer)
        elif self._state == "on the way" and self.interrupted:
            self._cancel("stopping")
        elif self._now() > self._deadline:
            if self._state == "on the way":
                self._cancel("giving up")
                self._deadline = self._now() + 1.0
            elif self._state == "stopping":
                self._end(4, "the goal was cancelled, and has not ended within 5 s")
            elif self._state == "waiting for the robot to stand":
                self._end(4, "CANCELED, but the robot still does not stand")
            else:
                self._end(1, f"no word while {self._state}")

    def _cancel(self, state):
        self._enter(state)
        self._handle.cancel_goal_async()

    def _on_feedback(self, message):
        if self._state == "on the way":
            self._deadline = self._now() + PATIENCE

    def _on_answer(self, future):
        self._handle = future.result()
        if not self._handle.accepted:
            self._end(2, "the goal was rejected")
            return
        self._enter("on the way")
        self._handle.get_result_async().add_done_callback(self._on_result)
        self._look_at_the_battery()

    def _on_result(self, future):
        status, result = future.result().status, future.result().result
        if self._state == "giving up":
            self._end(1, "navigate_to_pose was silent for 5 s; the goal is cancelled")
        elif status == GoalStatus.STATUS_SUCCEEDED:
            self._end(0, "SUCCEEDED")
        elif status != GoalStatus.STATUS_CANCELED:
            self._end(3, f"ABORTED, code {result.error_code}: {result.error_msg}")
        elif self._state == "on the way" or self._stands:
            self._end(4, "CANCELED")
        else:
            self._enter("waiting for the robot to stand")


def parse(argv):
    parser = argparse.ArgumentParser(prog="battery_guard")
    for name in ("x", "y"):
        parser.add_argument(name, type=float)
    parser.add_argument("yaw", type=float, nargs="?", default=0.0)
    return parser.parse_args(rclpy.utilities.remove_ros_args(argv)[1:])


def main(args=None):
    argv = args or sys.argv
    wanted = parse(argv)
    goal = NavigateToPose.Goal(tolerance=0.10)
    goal.pose.header.frame_id = "odom"
    goal.pose.pose.position.x, goal.pose.pose.position.y = wanted.x, wanted.y
    goal.pose.pose.orientation.z = math.sin(wanted.yaw / 2)
    goal.pose.pose.orientation.w = math.cos(wanted.yaw / 2)

    rclpy.init(args=argv, signal_handler_options=SignalHandlerOptions.NO)
    guard = Guard(goal)

    def on_interrupt(*_):
        guard.interrupted = True

    signal.signal(signal.SIGINT, on_interrupt)
    rclpy.spin_until_future_complete(guard, guard.over)
    status, line = guard.over.result()
    print(line, file=sys.stdout if status in (0, 4) else sys.stderr)
    guard.destroy_node()
    rclpy.try_shutdown()
    return status


if __name__ == "__main__":
    sys.exit(main())
