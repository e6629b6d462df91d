"""Style: one coroutine that awaits futures, each raced by a timer; spin_until_future_complete runs it to its end."""

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
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from sensor_msgs.msg import BatteryState

PATIENCE = 5.0  # s


class Guard(Node):
    def __init__(self):
        super().__init__("battery_guard")
        latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.interrupted = False
        self.level = self.mode = None
        self.heard = 0
        self.ignored = 0
        self.create_subscription(BatteryState, "battery_state", self.on_battery, latched)
        self.create_subscription(RobotState, "robot_state", self.on_robot, latched)
        self.client = ActionClient(self, NavigateToPose, "navigate_to_pose")

    def on_battery(self, message):
        if not (message.percentage >= 0.0 and message.percentage <= 1.0):
            self.ignored += 1
            if self.ignored == 1:
                print("ignored: NaN or a number outside 0..1 from the battery", file=sys.stderr)
        else:
            self.level = message.percentage

    def on_robot(self, message):
        self.mode = message.mode

    def on_feedback(self, message):
        self.heard += 1

    def low(self):
        return self.level is not None and self.level < 0.20

    async def until(self, condition, patience=PATIENCE, lively=False):
        """Await the condition; return False after `patience` s, begun anew by each feedback if it is `lively`."""
        done = Future()
        ticks = [0, self.heard]

        def tick():
            ticks[0] += 1
            if lively and self.heard != ticks[1]:
                ticks[:] = 0, self.heard
            if condition() or ticks[0] > patience / 0.05:
                done.set_result(bool(condition()))
                timer.cancel()

        timer = self.create_timer(0.05, tick)
        await done
        self.destroy_timer(timer)
        return done.result()

    async def go(self, goal):
        """Return the exit status and the line that says how it ended."""
        if not await self.until(lambda: self.level is not None):
            return 1, "battery_state says nothing useful"
        if not await self.until(lambda: self.low() or self.client.server_is_ready()):
            return 1, "there is no navigate_to_pose"
        if self.low():
            return 4, "not sent: low battery"
        answer = self.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        if not await self.until(answer.done):
            return 1, "no answer to the goal"
        handle = answer.result()
        if not handle.accepted:
            return 2, "rejected"
        end = handle.get_result_async()
        if not await self.until(lambda: end.done() or self.low() or self.interrupted, lively=True):
            handle.cancel_goal_async()
            await self.until(end.done, 0.5)
            return 1, "silence"
        if not end.done():
            handle.cancel_goal_async()
            if not await self.until(end.done):
                return 4, "asked to cancel; no end in sight"
            if end.result().status == GoalStatus.STATUS_CANCELED:
                stands = await self.until(lambda: self.mode == RobotState.STANDING)
                return 4, "CANCELED; " + ("standing" if stands else "not standing yet")
        response = end.result()
        if response.status == GoalStatus.STATUS_SUCCEEDED:
            return 0, "SUCCEEDED"
        if response.status == GoalStatus.STATUS_CANCELED:
            return 4, "CANCELED by somebody else"
        return 3, f"ABORTED: {response.result.error_msg}"


def main(args=None):
    parser = argparse.ArgumentParser(description="Go to X Y [YAW] while the battery lasts.")
    parser.add_argument("pose", type=float, nargs="+")
    pose = parser.parse_args(rclpy.utilities.remove_ros_args(args or sys.argv)[1:]).pose
    if not 2 <= len(pose) <= 3:
        parser.error("two or three numbers")
    x, y, yaw = pose if len(pose) == 3 else [*pose, 0.0]
    goal = NavigateToPose.Goal()
    goal.pose.header.frame_id = "odom"
    goal.pose.pose.position.x, goal.pose.pose.position.y = x, y
    goal.pose.pose.orientation.z, goal.pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = Guard()
    signal.signal(signal.SIGINT, lambda *_: setattr(node, "interrupted", True))
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(node)
    task = executor.create_task(node.go, goal)
    executor.spin_until_future_complete(task)
    status, line = task.result()
    print(line, file=sys.stdout if status in (0, 4) else sys.stderr)
    node.destroy_node()
    rclpy.try_shutdown()
    return status


if __name__ == "__main__":
    sys.exit(main())
