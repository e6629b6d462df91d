"""Style: the odom callback walks and execute waits for an Event; handle_accepted_callback aborts the old goal; a
cancel ends only once the robot stands.
"""

import math
import threading

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node

STANDING_SPEED = 0.04  # m/s



def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    return max(-most, min(most, value))


class Walk:
    """One goal on its way: everything is changed under the server's lock."""

    def __init__(self, goal_handle, first_step):
        self.goal_handle = goal_handle
        self.first_step = first_step
        self.rounds = 0
        self.calm = 0
        self.result = WalkTo.Result()
        self.over = threading.Event()


class WalkServer(Node):
    def __init__(self):
        super().__init__("walk_server")
        self.lock = threading.RLock()
        self.odom = None
        self.state = None
        self.walk = None
        self.walks = {}
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        sensing = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Odometry, "odom", self.on_odom, 10, callback_group=sensing)
        self.create_subscription(RobotState, "robot_state", self.on_state, 10, callback_group=sensing)
        self.server = ActionServer(
            self,
            WalkTo,
            "walk_to",
            execute_callback=self.execute,
            callback_group=MutuallyExclusiveCallbackGroup(),
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=self.on_cancel,
        )

    def on_goal(self, request):
        pose = request.target_pose.pose
        p, q = pose.position, pose.orientation
        if request.target_pose.header.frame_id != "odom":
            self.get_logger().warning("rejected: the pose must be in frame odom")
            return GoalResponse.REJECT
        if not all(math.isfinite(v) for v in (p.x, p.y, p.z, q.x, q.y, q.z, q.w)):
            self.get_logger().warning("rejected: the pose must be finite")
            return GoalResponse.REJECT
        if self.odom is None or self.state is None or not self.state.motors_enabled:
            self.get_logger().warning("rejected: the motors are off")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def on_accepted(self, goal_handle):
        with self.lock:
            if self.walk and self.walk.goal_handle.is_cancel_requested:
                self.end(self.walk.goal_handle.canceled)
            elif self.walk:
                self.end(self.walk.goal_handle.abort, WalkTo.Result.PREEMPTED, "preempted")
            self.walk = self.walks[bytes(goal_handle.goal_id.uuid)] = Walk(goal_handle, self.state.steps)
            goal_handle.execute()

    def execute(self, goal_handle):
        walk = self.walks.pop(bytes(goal_handle.goal_id.uuid))
        while rclpy.ok() and not walk.over.wait(0.1):
            pass
        return walk.result

    def end(self, terminal_call, code=WalkTo.Result.NONE, message=""):
        walk, self.walk = self.walk, None
        walk.result.error_code = code
        walk.result.error_msg = message
        walk.result.final_pose = self.pose()
        walk.result.total_steps = self.state.steps - walk.first_step
        terminal_call()
        walk.over.set()

    def on_state(self, state):
        self.state = state
        with self.lock:
            if self.walk and state.mode == RobotState.FALLEN:
                self.end(self.walk.goal_handle.abort, WalkTo.Result.FELL, "the robot fell")

    def on_odom(self, odom):
        self.odom = odom
        with self.lock:
            if self.walk:
                self.go_on(self.walk)

    def go_on(self, walk):
        target = walk.goal_handle.request.target_pose.pose
        here = self.odom.pose.pose
        dx, dy = target.position.x - here.position.x, target.position.y - here.position.y
        heading = yaw_of(here.orientation)
        turn = wrap(yaw_of(target.orientation) - heading)
        distance = math.hypot(dx, dy)
        canceling = walk.goal_handle.is_cancel_requested
        command = Twist()
        if not canceling and (distance > 0.06 or abs(turn) > 0.08):
            command.linear.x = limit(dx * math.cos(heading) + dy * math.sin(heading), 0.35)
            command.linear.y = limit(dy * math.cos(heading) - dx * math.sin(heading), 0.1)
            command.angular.z = limit(turn, 0.4)
        self.cmd_vel.publish(command)

        speed = self.odom.twist.twist.linear
        still = command == Twist() and math.hypot(speed.x, speed.y) < STANDING_SPEED
        walk.calm = walk.calm + 1 if still else 0
        if canceling and walk.calm >= 6:
            return self.end(walk.goal_handle.canceled)
        if not canceling and walk.calm >= 16:
            return self.end(walk.goal_handle.succeed)

        walk.rounds += 1
        if walk.rounds % 4 == 0:
            feedback = WalkTo.Feedback(current_pose=self.pose(), distance_remaining=distance)
            feedback.estimated_time_remaining.sec = math.ceil(distance / 0.35)
            feedback.steps_taken = self.state.steps - walk.first_step
            walk.goal_handle.publish_feedback(feedback)

    def pose(self):
        return PoseStamped(header=self.odom.header, pose=self.odom.pose.pose)


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
