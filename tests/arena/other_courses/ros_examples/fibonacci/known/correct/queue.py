"""Style: goals wait for their turn in a queue, cancels do not."""

import collections
import threading
import time

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class QueuingServer(Node):
    def __init__(self):
        super().__init__("minimal_action_server")
        self.waiting = collections.deque()
        self.current = None
        self.lock = threading.Lock()
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
        with self.lock:
            if self.current is None:
                self.current = goal_handle
                goal_handle.execute()
            else:
                self.waiting.append(goal_handle)

    def execute(self, goal_handle):
        try:
            return self.count(goal_handle)
        finally:
            with self.lock:
                self.current = self.waiting.popleft() if self.waiting else None
                if self.current is not None:
                    self.current.execute()

    def count(self, goal_handle):
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
        rclpy.spin(QueuingServer(), executor=MultiThreadedExecutor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
