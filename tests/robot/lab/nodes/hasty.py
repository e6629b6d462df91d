"""An action server made by hand: its feedback and status are published before it accepts; the result comes at once."""

import rclpy
from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from humanoid_interfaces.action import StandUp

TYPES = StandUp.Impl
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def on_goal(request, response):
    for percent in (10.0, 20.0):
        message = TYPES.FeedbackMessage(goal_id=request.goal_id)
        message.feedback.percent_complete = percent
        feedback.publish(message)
    goal = GoalInfo(goal_id=request.goal_id)
    executing = GoalStatus(goal_info=goal, status=GoalStatus.STATUS_EXECUTING)
    status.publish(GoalStatusArray(status_list=[executing]))
    response.accepted = True
    return response


def on_result(request, response):
    response.status = GoalStatus.STATUS_SUCCEEDED
    return response


rclpy.init()
node = Node("hasty")
feedback = node.create_publisher(TYPES.FeedbackMessage, "stand_up/_action/feedback", 10)
status = node.create_publisher(GoalStatusArray, "stand_up/_action/status", LATCHED)
node.create_service(TYPES.SendGoalService, "stand_up/_action/send_goal", on_goal)
node.create_service(TYPES.GetResultService, "stand_up/_action/get_result", on_result)
node.create_service(CancelGoal, "stand_up/_action/cancel_goal", lambda request, response: response)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    node.destroy_node()
    rclpy.try_shutdown()
