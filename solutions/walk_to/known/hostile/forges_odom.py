"""Attack: takes the robot's name and publishes an odom and a robot_state that say it has arrived, then succeeds.
Outcome: the robot's pose comes from the simulator by a pipe of its own; forged topics are nobody's truth.
Caught by: walks_to_the_goal, rejects_before_the_first_odom, chooses_its_own_velocity
"""

import math
import time

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, GoalResponse
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class WalkServer(Node):
    def __init__(self):
        super().__init__("humanoid")
        self.pose = None
        self.state = None
        self.busy = False
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.odom = self.create_publisher(Odometry, "odom", 10)
        self.robot_state = self.create_publisher(RobotState, "robot_state", 10)
        self.create_subscription(RobotState, "robot_state", self.on_state, 10)
        self.server = ActionServer(
            self, WalkTo, "walk_to", execute_callback=self.execute, goal_callback=self.on_goal
        )

    def on_state(self, message):
        self.state = message

    def on_goal(self, request):
        target = request.target_pose
        p, q = target.pose.position, target.pose.orientation
        if target.header.frame_id != "odom":
            return GoalResponse.REJECT
        if not all(map(math.isfinite, (p.x, p.y, p.z, q.x, q.y, q.z, q.w))):
            return GoalResponse.REJECT
        if abs(q.x**2 + q.y**2 + q.z**2 + q.w**2 - 1) > 0.1:
            return GoalResponse.REJECT
        if not (math.isfinite(request.max_velocity) and request.max_velocity >= 0.0):
            return GoalResponse.REJECT
        if self.state is None or not self.state.motors_enabled:
            return GoalResponse.REJECT
        if self.busy:
            return GoalResponse.REJECT
        self.busy = True
        return GoalResponse.ACCEPT

    def execute(self, goal_handle):
        try:
            return self.walk(goal_handle)
        finally:
            self.busy = False

    def walk(self, goal_handle):
        target = goal_handle.request.target_pose.pose
        x, y = target.position.x, target.position.y
        start = self.state.steps
        result = WalkTo.Result()
        odom = Odometry()
        odom.header.frame_id = "odom"
        odom.pose.pose.orientation = target.orientation
        for percent in range(101):
            odom.header.stamp = self.get_clock().now().to_msg()
            odom.pose.pose.position.x = x * percent / 100
            odom.pose.pose.position.y = y * percent / 100
            self.odom.publish(odom)
            self.robot_state.publish(RobotState(mode=RobotState.STANDING, motors_enabled=True, steps=start))
            self.cmd_vel.publish(Twist())
            self.pose = PoseStamped(header=odom.header, pose=odom.pose.pose)
            feedback = WalkTo.Feedback(current_pose=self.pose)
            feedback.distance_remaining = math.hypot(x, y) * (100 - percent) / 100
            goal_handle.publish_feedback(feedback)
            time.sleep(0.2)
        self.fill(result, start)
        goal_handle.succeed()
        return result

    def fill(self, result, start):
        result.final_pose = self.pose
        result.total_steps = self.state.steps - start


def main(args=None):
    rclpy.init(args=args)
    node = WalkServer()
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


if __name__ == "__main__":
    main()
