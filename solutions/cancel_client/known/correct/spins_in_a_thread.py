"""Style: a thread spins, another reads, and the main thread takes from a queue what they tell it."""

import argparse
import math
import queue
import signal
import sys
import threading
import time

import rclpy
from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import WalkTo
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

PATIENCE = 5.0


def complain(text):
    print(text, file=sys.stderr)


class Inbox:
    """What happened, in order: pairs of a name and a value."""

    def __init__(self):
        self._queue = queue.SimpleQueue()

    def put(self, what, value=None):
        self._queue.put((what, value))

    def when_done(self, future, what):
        future.add_done_callback(lambda done: self.put(what, done.result()))

    def get(self, deadline):
        """Return the next, or a pair ("nothing", None) at the deadline."""
        while True:
            try:
                return self._queue.get(timeout=0.05)
            except queue.Empty:
                if time.monotonic() > deadline:
                    return "nothing", None


def read(inbox):
    while line := sys.stdin.readline():
        if line.strip() == "q":
            inbox.put("q")


def follow(client, goal, inbox):
    if not client.wait_for_server(timeout_sec=PATIENCE):
        complain("walk_to is not there")
        return 1
    sent = client.send_goal_async(goal, feedback_callback=lambda message: inbox.put("feedback", message.feedback))
    inbox.when_done(sent, "answer")
    handle, cancelled, stopping = None, False, False
    wanted = False
    deadline = time.monotonic() + PATIENCE
    while True:
        what, value = inbox.get(deadline)
        if what == "nothing" and stopping:
            print("CANCELED by Ctrl-C; the goal has not ended")
            return 4
        if what == "nothing":
            if handle and not cancelled:
                handle.cancel_goal_async()
                time.sleep(0.2)
            complain("walk_to is silent")
            return 1
        if what == "feedback":
            print(f"{value.distance_remaining:.2f}", flush=True)
            deadline = deadline if stopping else time.monotonic() + PATIENCE
        elif what == "answer":
            if not value.accepted:
                complain("the goal was rejected")
                return 2
            handle = value
            inbox.when_done(handle.get_result_async(), "result")
            deadline = time.monotonic() + PATIENCE
        elif what == "cancel answer":
            if value.goals_canceling:
                print("it stops", flush=True)
            else:
                print(f"The cancel was refused, code {value.return_code}", flush=True)
        elif what == "result" and stopping and value.status != GoalStatus.STATUS_CANCELED:
            print(f"interrupted, but the goal ended with status {value.status}")
            return 4
        elif what == "result":
            return report(value)
        wanted = wanted or what in ("q", "ctrl-c")
        if wanted and handle and not cancelled:
            cancelled = True
            inbox.when_done(handle.cancel_goal_async(), "cancel answer")
        if what == "ctrl-c":
            stopping, deadline = True, time.monotonic() + PATIENCE - 0.5


def report(response):
    at = response.result.final_pose.pose
    if response.status == GoalStatus.STATUS_SUCCEEDED:
        print(f"SUCCEEDED: x={at.position.x:.2f} y={at.position.y:.2f}")
        return 0
    if response.status == GoalStatus.STATUS_CANCELED:
        print(f"CANCELED: x={at.position.x:.2f} y={at.position.y:.2f}")
        return 4
    complain(f"ABORTED ({response.result.error_code}): {response.result.error_msg}")
    return 3


def main(args=None):
    parser = argparse.ArgumentParser()
    parser.add_argument("x", type=float)
    parser.add_argument("y", type=float)
    parser.add_argument("yaw", type=float, nargs="?", default=0.0)
    wanted = parser.parse_args(rclpy.utilities.remove_ros_args(args or sys.argv)[1:])
    inbox = Inbox()
    signal.signal(signal.SIGINT, lambda *_: inbox.put("ctrl-c"))
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("cancel_client")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    spinning = threading.Thread(target=executor.spin)
    spinning.start()
    threading.Thread(target=read, args=[inbox], daemon=True).start()
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "odom"
    goal.target_pose.pose.position.x = wanted.x
    goal.target_pose.pose.position.y = wanted.y
    goal.target_pose.pose.orientation.w = math.cos(0.5 * wanted.yaw)
    goal.target_pose.pose.orientation.z = math.sin(0.5 * wanted.yaw)
    try:
        return follow(ActionClient(node, WalkTo, "walk_to"), goal, inbox)
    finally:
        executor.shutdown()
        spinning.join()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())
