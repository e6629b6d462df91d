"""Style: functions and no class, a coroutine that sleeps on a thread of its own."""

import time

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from test_msgs.action import Fibonacci


def agree(goal_handle):
    return CancelResponse.ACCEPT


async def execute(goal_handle):
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
    rclpy.init(args=args)
    node = rclpy.create_node("minimal_action_server")
    server = ActionServer(
        node,
        Fibonacci,
        "fibonacci",
        execute_callback=execute,
        cancel_callback=agree,
        callback_group=ReentrantCallbackGroup(),
    )
    try:
        rclpy.spin(node, executor=MultiThreadedExecutor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        server.destroy()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
