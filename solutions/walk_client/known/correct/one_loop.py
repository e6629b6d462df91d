"""Style: as in the notebook: one loop that spins, looks at the clock and at Ctrl-C."""

import argparse
import math
import signal
import sys
import threading
import time

import rclpy
from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import WalkTo
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

PATIENCE = 5.0  # s without a word from the server
TICK = 0.1  # s between two looks at the clock
SUCCEEDED, NO_SERVER, REJECTED, ABORTED, CANCELED = range(5)


class Failure(Exception):
    """How the program ends: an exit status and a sentence."""

    def __init__(self, status, reason):
        super().__init__(reason)
        self.status = status


class WalkClient(Node):
    def __init__(self, interrupted):
        super().__init__("walk_client")
        self._walk_to = ActionClient(self, WalkTo, "walk_to")
        self._interrupted = interrupted  # a threading.Event that Ctrl-C sets
        self._last_heard = time.monotonic()

    def walk(self, x, y, yaw):
        """Send the goal and follow it to its end; return the exit status and the line that says how it ended."""
        if not self._walk_to.wait_for_server(timeout_sec=PATIENCE):
            raise Failure(NO_SERVER, f"nobody offers walk_to within {PATIENCE:g} s")
        handle = self._wait(
            self._walk_to.send_goal_async(goal_to(x, y, yaw), feedback_callback=self._on_feedback)
        )
        if handle is None:
            raise Failure(NO_SERVER, f"walk_to has not answered within {PATIENCE:g} s")
        if not handle.accepted:
            raise Failure(REJECTED, "walk_to has rejected the goal")
        ended = handle.get_result_async()
        response = self._wait(ended, until=self._interrupted.is_set)
        if self._interrupted.is_set():
            handle.cancel_goal_async()
            latest = time.monotonic() + PATIENCE  # a limit on the time, as feedback may go on
            self._wait(ended, until=lambda: time.monotonic() > latest)
            return CANCELED, after_ctrl_c(ended)
        if response is None:
            self._wait(handle.cancel_goal_async(), patience=1.0)
            raise Failure(NO_SERVER, f"nothing heard of walk_to for {PATIENCE:g} s; the goal is canceled")
        return ending(response)

    def _on_feedback(self, message):
        self._last_heard = time.monotonic()
        print(f"{message.feedback.distance_remaining:.2f} m to go", flush=True)

    def _wait(self, future, patience=PATIENCE, until=lambda: False):
        """Spin until the future is done; return its result, or None after `patience` s of silence or `until()`."""
        self._last_heard = time.monotonic()
        while not future.done():
            if until() or time.monotonic() - self._last_heard > patience:
                return None
            rclpy.spin_once(self, timeout_sec=TICK)
        return future.result()


def goal_to(x, y, yaw):
    """Return a goal at a pose (m, m, rad) in odom."""
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "odom"
    goal.target_pose.pose.position.x = x
    goal.target_pose.pose.position.y = y
    goal.target_pose.pose.orientation.z = math.sin(yaw / 2)
    goal.target_pose.pose.orientation.w = math.cos(yaw / 2)
    return goal


def ending(response):
    """Return the exit status and the line for a goal that has ended: the status decides, then the code explains."""
    pose = response.result.final_pose.pose
    yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
    here = f"at x {pose.position.x:.2f} m, y {pose.position.y:.2f} m, yaw {yaw:.2f} rad"
    if response.status == GoalStatus.STATUS_SUCCEEDED:
        return SUCCEEDED, f"SUCCEEDED {here}"
    if response.status == GoalStatus.STATUS_CANCELED:
        return CANCELED, f"CANCELED {here}"
    result = response.result
    raise Failure(ABORTED, f"ABORTED with code {result.error_code}: {result.error_msg or 'no reason given'}")


def after_ctrl_c(ended):
    """Return the line for a goal that Ctrl-C has cancelled: it may have ended in another way, or not at all."""
    if not ended.done():
        return "Ctrl-C: asked to cancel, but the goal has not ended yet"
    words = {GoalStatus.STATUS_SUCCEEDED: "SUCCEEDED", GoalStatus.STATUS_CANCELED: "CANCELED"}
    return f"Ctrl-C: the goal {words.get(ended.result().status, 'ABORTED')}"


def arguments_of(args):
    parser = argparse.ArgumentParser(description="Walk the robot to a pose in odom.")
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
    node = WalkClient(interrupted)
    try:
        status, line = node.walk(arguments.x, arguments.y, arguments.yaw)
        print(line)
        return status
    except Failure as failure:
        print(failure, file=sys.stderr)
        return failure.status
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())
