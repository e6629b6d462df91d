"""Style: nothing waits and there is no thread; a timer asks the system whether there is something to read."""

import argparse
import math
import os
import select
import signal
import sys

import rclpy
from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import WalkTo
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

PATIENCE = 5.0  # s
CHECKS = 0.1  # s between two looks of the watchdog
ENDINGS = {
    GoalStatus.STATUS_SUCCEEDED: "succeeded",
    GoalStatus.STATUS_ABORTED: "aborted",
    GoalStatus.STATUS_CANCELED: "canceled",
}


class Walk(Node):
    def __init__(self, goal):
        super().__init__("cancel_client")
        self.over = Future()  # (exit status, line)
        self.interrupted = False
        self._input = b""
        self._input_is_open = True
        self._wants_to_cancel = False
        self._asked = False
        self._goal = goal
        self._handle = None
        self._state = "looking for walk_to"
        self._client = ActionClient(self, WalkTo, "walk_to")
        self._deadline = self._now() + PATIENCE
        self.create_timer(CHECKS, self._watch)

    def _now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def _end(self, status, line):
        if not self.over.done():
            self.over.set_result((status, line))

    def _read(self):
        """Take what has been typed, without waiting for more."""
        while self._input_is_open and select.select([0], [], [], 0)[0]:
            words = os.read(0, 1000)
            self._input_is_open = bool(words)
            self._input += words
        *lines, self._input = self._input.split(b"\n")
        if any(line.strip() == b"q" for line in lines):
            self._wants_to_cancel = True

    def _watch(self):
        self._read()
        if self._state == "looking for walk_to" and self._client.server_is_ready():
            self._state = "waiting for the answer"
            self._deadline = self._now() + PATIENCE
            self._client.send_goal_async(self._goal, self._on_feedback).add_done_callback(self._on_answer)
        elif self.interrupted and self._state == "walking":
            self._cancel("stopping", PATIENCE)
        elif self._wants_to_cancel and self._state == "walking" and not self._asked:
            self._asked = True
            self._handle.cancel_goal_async().add_done_callback(self._on_answer_to_q)
        elif self._now() > self._deadline:
            if self._state == "walking":
                self._cancel("giving up", 1.0)
            elif self._state == "stopping":
                self._end(4, "CANCELED by Ctrl-C, but the goal has not ended yet")
            else:
                self._end(1, f"no word of walk_to while {self._state}")

    def _cancel(self, state, patience):
        self._state = state
        self._deadline = self._now() + patience
        self._handle.cancel_goal_async().add_done_callback(self._on_cancel_answer)

    def _on_answer_to_q(self, future):
        if future.result().goals_canceling:
            print("the server agrees to cancel", flush=True)
        else:
            print("the server has refused to cancel", flush=True)

    def _on_cancel_answer(self, future):
        if self._state == "giving up":
            self._end(1, "nothing was heard for 5 s; the goal is canceled")

    def _on_feedback(self, message):
        print(f"distance remaining: {message.feedback.distance_remaining:.3f} m", flush=True)
        if self._state == "walking":
            self._deadline = self._now() + PATIENCE

    def _on_answer(self, future):
        self._handle = future.result()
        if not self._handle.accepted:
            self._end(2, "the goal was rejected")
            return
        self._state = "walking"
        self._deadline = self._now() + PATIENCE
        self._handle.get_result_async().add_done_callback(self._on_result)

    def _on_result(self, future):
        status, result = future.result().status, future.result().result
        pose = result.final_pose.pose
        heading = math.degrees(2 * math.atan2(pose.orientation.z, pose.orientation.w))
        where = f"({pose.position.x:.3f}, {pose.position.y:.3f}) m, {heading:.0f} degrees"
        if self._state == "stopping":
            self._end(4, f"interrupted; {ENDINGS.get(status, 'ended')} at {where}")
        elif status == GoalStatus.STATUS_CANCELED:
            self._end(4, f"canceled at {where}")
        elif status == GoalStatus.STATUS_SUCCEEDED:
            self._end(0, f"succeeded at {where}")
        else:
            self._end(3, f"aborted, code {result.error_code}: {result.error_msg}")


def parse(argv):
    parser = argparse.ArgumentParser(prog="walk_client")
    for name in ("x", "y"):
        parser.add_argument(name, type=float)
    parser.add_argument("yaw", type=float, nargs="?", default=0.0)
    return parser.parse_args(rclpy.utilities.remove_ros_args(argv)[1:])


def main(args=None):
    argv = args or sys.argv
    wanted = parse(argv)
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "odom"
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = wanted.x, wanted.y
    goal.target_pose.pose.orientation.z = math.sin(wanted.yaw / 2)
    goal.target_pose.pose.orientation.w = math.cos(wanted.yaw / 2)

    rclpy.init(args=argv, signal_handler_options=SignalHandlerOptions.NO)
    walk = Walk(goal)

    def on_interrupt(*_):
        walk.interrupted = True

    signal.signal(signal.SIGINT, on_interrupt)
    rclpy.spin_until_future_complete(walk, walk.over)
    status, line = walk.over.result()
    print(line, file=sys.stdout if status in (0, 4) else sys.stderr)
    walk.destroy_node()
    rclpy.try_shutdown()
    return status


if __name__ == "__main__":
    sys.exit(main())
