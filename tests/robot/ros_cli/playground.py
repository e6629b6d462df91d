"""A node with an endpoint of each kind, for the commands. It prints "ready", then the messages that it receives."""

from __future__ import annotations

import time
from contextlib import suppress

import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool, String

from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.srv import AddTwoInts

PERIOD = 0.05  # s


class Playground(Node):
    """A goal with `max_velocity` below 0 is rejected; one above 1 runs until it is cancelled."""

    def __init__(self) -> None:
        super().__init__("playground", namespace="/demo")
        self.declare_parameter("gain", 1.5)
        self.declare_parameter("limits.low", 2)
        self.add_on_set_parameters_callback(self.validate)
        self.chatter = self.create_publisher(String, "chatter", 10)
        self.create_timer(PERIOD, lambda: self.chatter.publish(String(data="hello")))
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.power = self.create_publisher(Bool, "power", latched)
        self.power.publish(Bool(data=True))
        self.create_subscription(Twist, "cmd_vel", self.hear, 10)
        self.create_service(AddTwoInts, "add", self.add)
        self.server = ActionServer(
            self,
            WalkTo,
            "walk_to",
            self.walk,
            callback_group=ReentrantCallbackGroup(),
            goal_callback=lambda goal: GoalResponse.REJECT if goal.max_velocity < 0 else GoalResponse.ACCEPT,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def validate(self, parameters):
        wrong = any(each.name == "gain" and each.value < 0 for each in parameters)
        return SetParametersResult(successful=not wrong, reason="gain is positive" if wrong else "")

    def hear(self, message):
        print(f"cmd_vel {message.linear.x}", flush=True)

    def add(self, request, response):
        response.sum = request.a + request.b
        return response

    def walk(self, handle):
        steps = 0
        while steps < 3 or handle.request.max_velocity > 1:
            if handle.is_cancel_requested:
                handle.canceled()
                print("goal canceled", flush=True)
                return WalkTo.Result(total_steps=steps)
            steps += 1
            handle.publish_feedback(WalkTo.Feedback(steps_taken=steps))
            time.sleep(PERIOD)
        handle.succeed()
        return WalkTo.Result(total_steps=steps)


def main() -> None:
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    executor.add_node(Playground())
    print("ready", flush=True)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


if __name__ == "__main__":
    main()
