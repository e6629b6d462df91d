"""An action that takes 2 s in ten phases.

Its one argument is how it treats goals: cancel, no-cancel, reject or doubt (it waits for 1 s before it accepts).
"""

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


def decide(goal):
    if HABIT == "doubt":
        time.sleep(1.0)
    return GoalResponse.REJECT if HABIT == "reject" else GoalResponse.ACCEPT


rclpy.init()
node = Node("riser")
server = ActionServer(
    node,
    StandUp,
    "stand_up",
    rise,
    goal_callback=decide,
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
