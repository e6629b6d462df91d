"""Style: a thread spins; the main thread waits on events, and Ctrl-C is the KeyboardInterrupt that it gets."""

import argparse
import math
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
ENDINGS = {GoalStatus.STATUS_SUCCEEDED: 0, GoalStatus.STATUS_ABORTED: 3, GoalStatus.STATUS_CANCELED: 4}


def wait_for(future, timeout):
    """Wait in the main thread, in short pieces so that Ctrl-C gets through; return whether the future is done."""
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    deadline = time.monotonic() + timeout
    while time.monotonic() < deadline:
        if done.wait(0.05):
            return True
    return future.done()


def complain(text):
    print(text, file=sys.stderr)


def follow(client, goal):
    heard = [time.monotonic()]

    def on_feedback(message):
        heard[0] = time.monotonic()
        print(f"{message.feedback.distance_remaining:.2f}", flush=True)

    if not client.wait_for_server(timeout_sec=PATIENCE):
        complain("walk_to is not there")
        return 1
    sent = client.send_goal_async(goal, feedback_callback=on_feedback)
    if not wait_for(sent, PATIENCE):
        complain("the goal was not answered")
        return 1
    handle = sent.result()
    if not handle.accepted:
        complain("the goal was rejected")
        return 2
    result = handle.get_result_async()
    heard[0] = time.monotonic()
    try:
        while not wait_for(result, 0.1):
            if time.monotonic() - heard[0] > PATIENCE:
                wait_for(handle.cancel_goal_async(), 1.0)
                complain("the server has fallen silent")
                return 1
    except KeyboardInterrupt:
        handle.cancel_goal_async()
        if not wait_for(result, PATIENCE - 0.5):
            print("CANCELED (Ctrl-C), though it goes on")
        elif result.result().status == GoalStatus.STATUS_CANCELED:
            print("CANCELED (Ctrl-C)")
        else:
            print(f"interrupted, but the goal ended with status {result.result().status}")
        return 4
    return report(result.result())


def report(response):
    at = response.result.final_pose.pose
    yaw = 2 * math.atan2(at.orientation.z, at.orientation.w)
    status = ENDINGS.get(response.status, 3)
    if status == 3:
        complain(f"ABORTED ({response.result.error_code}): {response.result.error_msg}")
    else:
        word = "SUCCEEDED" if status == 0 else "CANCELED"
        print(f"{word}: x={at.position.x:.2f} y={at.position.y:.2f} yaw={yaw:.2f}")
    return status


def main(args=None):
    parser = argparse.ArgumentParser()
    parser.add_argument("x", type=float)
    parser.add_argument("y", type=float)
    parser.add_argument("yaw", type=float, nargs="?", default=0.0)
    wanted = parser.parse_args(rclpy.utilities.remove_ros_args(args or sys.argv)[1:])
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("walk_client")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    spinning = threading.Thread(target=executor.spin)
    spinning.start()
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "odom"
    goal.target_pose.pose.position.x = wanted.x
    goal.target_pose.pose.position.y = wanted.y
    goal.target_pose.pose.orientation.w = math.cos(0.5 * wanted.yaw)
    goal.target_pose.pose.orientation.z = math.sin(0.5 * wanted.yaw)
    try:
        return follow(ActionClient(node, WalkTo, "walk_to"), goal)
    finally:
        executor.shutdown()
        spinning.join()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())
