"""An action that takes 2 s in ten phases; its one argument is how it treats goals: cancel, no-cancel or reject."""

import sys
import time

import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node

from humanoid_interfaces.action import StandUp

HABIT = sys.argv[1]


def rise(goal):
    for phase in range(10):
        if goal.is_cancel_requested:
            goal.canceled()
            return StandUp.Result(error_msg="sat down again")
        goal.publish_feedback(StandUp.Feedback(phase="rising", percent_complete=10.0 * phase))
        time.sleep(0.2)
    goal.succeed()
    return StandUp.Result(error_msg="up")


rclpy.init()
node = Node("riser")
server = ActionServer(
    node,
    StandUp,
    "stand_up",
    rise,
    goal_callback=lambda goal: GoalResponse.REJECT if HABIT == "reject" else GoalResponse.ACCEPT,
    cancel_callback=lambda goal: CancelResponse.ACCEPT if HABIT == "cancel" else CancelResponse.REJECT,
)
executor = MultiThreadedExecutor()
executor.add_node(node)
try:
    executor.spin()
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    executor.shutdown()
    node.destroy_node()
    rclpy.try_shutdown()
