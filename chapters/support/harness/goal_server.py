"""A test double of the action server go_ahead; its arguments are the statuses in which the goals end.

    goal_server.py SUCCEEDED UNKNOWN     the first goal succeeds, the second one ends with the status UNKNOWN

rclpy's ActionServer can't be made to return UNKNOWN, the status of a goal that it has discarded. So this node offers
the services and topics that an action consists of.
"""

from __future__ import annotations

from typing import Any

import rclpy
from action_msgs.msg import GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_action_status_default
from rclpy.utilities import remove_ros_args

from humanoid_interfaces.action import WalkTo

STEPS = 37
REASON = "somebody stands in the way"
RESULTS = {
    "SUCCEEDED": WalkTo.Result(total_steps=STEPS),
    "UNKNOWN": WalkTo.Result(),
}
FAILED = WalkTo.Result(total_steps=STEPS, error_code=WalkTo.Result.TIMEOUT, error_msg=REASON)


def main() -> None:
    """Run the node until Ctrl-C."""
    rclpy.init()
    ends = iter(remove_ros_args()[1:])
    node = Node("goal_server")
    action, types = "go_ahead/_action", WalkTo.Impl
    feedback = node.create_publisher(types.FeedbackMessage, f"{action}/feedback", 10)
    node.create_publisher(GoalStatusArray, f"{action}/status", qos_profile_action_status_default)

    def accept(_: Any, response: Any) -> Any:
        response.accepted = True
        return response

    def end(request: Any, response: Any) -> Any:
        feedback.publish(
            types.FeedbackMessage(goal_id=request.goal_id, feedback=WalkTo.Feedback(distance_remaining=0.25))
        )
        status = next(ends)
        response.status = getattr(GoalStatus, f"STATUS_{status}")
        response.result = RESULTS.get(status, FAILED)
        return response

    node.create_service(types.SendGoalService, f"{action}/send_goal", accept)
    node.create_service(types.GetResultService, f"{action}/get_result", end)
    node.create_service(CancelGoal, f"{action}/cancel_goal", lambda _, response: response)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
