"""Style: an accepted goal begins three seconds later, when a timer says so."""

import time

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class DeferringServer(Node):
    def __init__(self):
        super().__init__("minimal_action_server")
        self.goal_handle = None
        self.timer = None
        self.server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            execute_callback=self.execute,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def on_accepted(self, goal_handle):
        self.goal_handle = goal_handle
        self.timer = self.create_timer(3.0, self.on_timer)

    def on_timer(self):
        self.timer.cancel()
        self.goal_handle.execute()

    async def execute(self, goal_handle):
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        for _ in range(1, goal_handle.request.order):
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return Fibonacci.Result()
            feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
            goal_handle.publish_feedback(feedback)
            time.sleep(1)
        goal_handle.succeed()
        return Fibonacci.Result(sequence=feedback.sequence)


def main(args=None):
    try:
        rclpy.init(args=args)
        rclpy.spin(DeferringServer(), executor=MultiThreadedExecutor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
