"""Style: as in the notebook: one loop that spins, and looks at the battery, at the clock and at Ctrl-C."""

import argparse
import math
import signal
import sys
import threading
import time

import rclpy
from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import BatteryState

LOW = 0.20
PATIENCE = 5.0  # s
TICK = 0.1  # s between two looks at the clock
SUCCEEDED, NO_SERVER, REJECTED, ABORTED, CANCELED = range(5)


class Failure(Exception):
    """How the program ends: an exit status and a sentence."""

    def __init__(self, status, reason):
        super().__init__(reason)
        self.status = status


class BatteryGuard(Node):
    def __init__(self, interrupted):
        super().__init__("battery_guard")
        self._interrupted = interrupted  # a threading.Event that Ctrl-C sets
        self._level = None  # the last percentage
        self._mode = None  # the last of robot_state
        self._last_heard = time.monotonic()
        qos = QoSProfile(depth=1)
        qos.durability = DurabilityPolicy.TRANSIENT_LOCAL
        self.create_subscription(BatteryState, "battery_state", self._on_battery, qos)
        self.create_subscription(RobotState, "robot_state", self._on_robot_state, qos)
        self._navigate = ActionClient(self, NavigateToPose, "navigate_to_pose")

    def go(self, goal):
        """Send the goal and follow it to its end; return the exit status and the line that says how it ended."""
        if not self._wait(lambda: self._level is not None):
            raise Failure(NO_SERVER, f"no percentage on battery_state within {PATIENCE:g} s")
        if not self._wait(lambda: self._is_low() or self._navigate.server_is_ready()):
            raise Failure(NO_SERVER, f"nobody offers navigate_to_pose within {PATIENCE:g} s")
        if self._is_low():
            return CANCELED, f"not sent: the battery is at {self._level:.3f}"
        answered = self._navigate.send_goal_async(goal, feedback_callback=self._on_feedback)
        if not self._wait(answered.done):
            raise Failure(NO_SERVER, f"navigate_to_pose has not answered within {PATIENCE:g} s")
        handle = answered.result()
        if not handle.accepted:
            raise Failure(REJECTED, "navigate_to_pose has rejected the goal")
        ended = handle.get_result_async()

        def is_over():
            if self._is_low() or self._interrupted.is_set():
                return True
            return ended.done()

        is_heard = self._wait(is_over, since_feedback=True)
        if not is_heard:
            handle.cancel_goal_async()
            self._wait(ended.done, patience=1.0)
            raise Failure(NO_SERVER, f"nothing heard of navigate_to_pose for {PATIENCE:g} s; the goal is canceled")
        if not ended.done():
            why = "Ctrl-C" if self._interrupted.is_set() else f"the battery is at {self._level:.3f}"
            return self._call_off(handle, ended, why)
        return ending(ended.result())

    def _call_off(self, handle, ended, why):
        """Cancel the goal, wait until it has ended and the robot stands; return the exit status and the line."""
        handle.cancel_goal_async()
        if not self._wait(ended.done):
            return CANCELED, f"cancelled, as {why}, but the goal has not ended yet"
        if ended.result().status != GoalStatus.STATUS_CANCELED:
            return ending(ended.result())
        if not self._wait(lambda: self._mode == RobotState.STANDING):
            return CANCELED, f"CANCELED: {why}; the robot does not stand yet"
        return CANCELED, f"CANCELED: {why}"

    def _is_low(self):
        return self._level < LOW

    def _on_battery(self, message):
        """Keep the percentage."""
        if not 0.0 <= message.percentage <= 1.0:  # NaN, too
            self.get_logger().warning(f"ignored: a percentage of {message.percentage}", once=True)
            return
        self._level = message.percentage

    def _on_robot_state(self, message):
        self._mode = message.mode

    def _on_feedback(self, message):
        self._last_heard = time.monotonic()

    def _wait(self, condition, patience=PATIENCE, since_feedback=False):
        """Spin until the condition holds; return False after `patience` s, if asked counted from the last feedback."""
        began = self._last_heard = time.monotonic()
        while not condition():
            if time.monotonic() - (self._last_heard if since_feedback else began) > patience:
                return False
            rclpy.spin_once(self, timeout_sec=TICK)
        return True


def goal_to(x, y, yaw):
    """Return a goal at a pose (m, m, rad) in odom."""
    goal = NavigateToPose.Goal()
    goal.pose.header.frame_id = "odom"
    goal.pose.pose.position.x = x
    goal.pose.pose.position.y = y
    goal.pose.pose.orientation.z = math.sin(yaw / 2)
    goal.pose.pose.orientation.w = math.cos(yaw / 2)
    return goal


def ending(response):
    """Return the exit status and the line for a goal that has ended: the status decides, then the code explains."""
    if response.status == GoalStatus.STATUS_SUCCEEDED:
        return SUCCEEDED, f"SUCCEEDED after {response.result.distance_traveled:.2f} m"
    if response.status == GoalStatus.STATUS_CANCELED:
        return CANCELED, f"CANCELED after {response.result.distance_traveled:.2f} m"
    raise Failure(ABORTED, f"ABORTED with code {response.result.error_code}: {response.result.error_msg}")


def arguments_of(args):
    parser = argparse.ArgumentParser(description="Walk the robot to a pose in odom, as long as the battery lasts.")
    parser.add_argument("x", type=float, help="m")
    parser.add_argument("y", type=float, help="m")
    parser.add_argument("yaw", type=float, nargs="?", default=0.0, help="rad")
    return parser.parse_args(rclpy.utilities.remove_ros_args(args)[1:])


def main(args=None):
    args = sys.argv if args is None else args
    arguments = arguments_of(args)
    interrupted = threading.Event()
    signal.signal(signal.SIGINT, lambda *_: interrupted.set())
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)  # else Ctrl-C takes the context away
    guard = BatteryGuard(interrupted)
    try:
        status, line = guard.go(goal_to(arguments.x, arguments.y, arguments.yaw))
        print(line)
        return status
    except Failure as failure:
        print(failure, file=sys.stderr)
        return failure.status
    finally:
        guard.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())
