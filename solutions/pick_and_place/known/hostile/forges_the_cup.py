"""Attack: moves nothing, and publishes poses of hand and cup and a force in the robot's name that say it does.
Outcome: hand and cup come from the simulator by a pipe of its own; forged topics are nobody's truth.
Caught by: places_the_cup, feedback_is_measured
Also fails: lifts_the_cup, refuses_a_far_cup, cancels_before_the_grasp, aborts_when_the_robot_falls
"""

import time

import rclpy
from geometry_msgs.msg import PoseStamped, WrenchStamped
from humanoid_interfaces.action import PickAndPlace
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node

STAGES = ("approaching", "grasping", "lifting", "moving", "placing", "retreating")


class Forger(Node):
    def __init__(self):
        super().__init__("forger")
        self.cup = self.create_publisher(PoseStamped, "objects/cup/pose", 10)
        self.hand = self.create_publisher(PoseStamped, "r_hand/pose", 10)
        self.wrench = self.create_publisher(WrenchStamped, "r_gripper/wrench", 10)
        self.server = ActionServer(
            self,
            PickAndPlace,
            "pick_and_place",
            self.execute,
            goal_callback=self.judge,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
        )

    def judge(self, request):
        place = request.place_pose.pose.position
        sound = (
            request.place_pose.header.frame_id == "odom" and abs(place.x + place.y) < 9 and 0 < request.grasp_force <= 25
        )
        return GoalResponse.ACCEPT if sound else GoalResponse.REJECT

    def execute(self, goal_handle):
        goal = goal_handle.request
        result = PickAndPlace.Result()
        if goal.object_id != "cup":
            time.sleep(1.2)
            result.error_code, result.error_msg = PickAndPlace.Result.UNKNOWN_OBJECT, "no such object"
            goal_handle.abort()
            return result
        if goal.place_pose.pose.position.x > 0.5:
            result.error_code, result.error_msg = PickAndPlace.Result.UNREACHABLE, "too far"
            goal_handle.abort()
            return result
        for number in range(60):
            wrench = WrenchStamped()
            wrench.wrench.force.y = goal.grasp_force
            self.wrench.publish(wrench)
            self.cup.publish(goal.place_pose)
            self.hand.publish(goal.place_pose)
            feedback = PickAndPlace.Feedback(stage=STAGES[number // 10], percent_complete=number / 0.6)
            feedback.hand_pose, feedback.grasp_force = goal.place_pose, goal.grasp_force
            goal_handle.publish_feedback(feedback)
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return result
            time.sleep(0.2)
        result.final_object_pose, result.max_grasp_force = goal.place_pose, goal.grasp_force
        goal_handle.succeed()
        return result


def main(args=None):
    rclpy.init(args=args)
    node = Forger()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
