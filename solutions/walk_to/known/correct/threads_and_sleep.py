"""Style: a class, MultiThreadedExecutor and time.sleep in the execute callback."""

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

PERIOD = 0.05
FEEDBACK_EVERY = 4
SETTLING = 30  # rounds


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    return max(-most, min(most, value))


class WalkServer(Node):
    def __init__(self):
        super().__init__("walk_server")
        self.pose = None
        self.state = None
        self.busy = False
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.create_subscription(RobotState, "robot_state", self.on_state, 10)
        self.server = ActionServer(
            self, WalkTo, "walk_to", execute_callback=self.execute, goal_callback=self.on_goal
        )

    def on_odom(self, message):
        self.pose = PoseStamped(header=message.header, pose=message.pose.pose)

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
        if self.pose is None:
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
        fastest = goal_handle.request.max_velocity or 0.35
        x, y, yaw = target.position.x, target.position.y, yaw_of(target.orientation)
        start = self.state.steps
        result = WalkTo.Result()
        still = 0
        rounds = 0
        while rclpy.ok():
            if self.state.mode == RobotState.FALLEN:
                result.error_code = WalkTo.Result.FELL
                result.error_msg = "the robot fell"
                self.fill(result, start)
                goal_handle.abort()
                return result
            here = self.pose.pose
            dx, dy = x - here.position.x, y - here.position.y
            distance = math.hypot(dx, dy)
            heading = yaw_of(here.orientation)
            turn = wrap(yaw - heading)
            command = Twist()
            if distance > 0.06 or abs(turn) > 0.08:
                still = 0
                vx = 0.8 * (math.cos(heading) * dx + math.sin(heading) * dy)
                vy = limit(0.8 * (-math.sin(heading) * dx + math.cos(heading) * dy), 0.1)
                scale = min(1.0, fastest / max(math.hypot(vx, vy), 1e-6))
                command.linear.x = scale * vx
                command.linear.y = scale * vy
                command.angular.z = limit(0.8 * turn, 0.4)
            else:
                still += 1
            self.cmd_vel.publish(command)
            if still > SETTLING:
                self.fill(result, start)
                goal_handle.succeed()
                return result
            if rounds % FEEDBACK_EVERY == 0:
                feedback = WalkTo.Feedback()
                feedback.current_pose = self.pose
                feedback.distance_remaining = distance
                feedback.steps_taken = self.state.steps - start
                feedback.estimated_time_remaining.sec = int(distance / fastest)
                goal_handle.publish_feedback(feedback)
            rounds += 1
            time.sleep(PERIOD)
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
