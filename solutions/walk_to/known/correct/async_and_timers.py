"""Style: one thread; an async execute callback that awaits a Future set by a one-shot timer; it stands when odom's twist
has been small for a while.
"""

import math

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, GoalResponse
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    return max(-most, min(most, value))


class WalkServer(Node):
    def __init__(self):
        super().__init__("walk_server")
        self.odom = None
        self.state = None
        self.current = None
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 1)
        self.create_subscription(Odometry, "odom", self.on_odom, 1)
        self.create_subscription(RobotState, "robot_state", self.on_state, 1)
        self.server = ActionServer(
            self,
            WalkTo,
            "walk_to",
            self.execute,
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
        )

    def on_odom(self, odom):
        self.odom = odom

    def on_state(self, state):
        self.state = state

    def on_goal(self, request):
        pose = request.target_pose.pose
        numbers = [getattr(pose.position, axis) for axis in "xyz"]
        numbers += [getattr(pose.orientation, axis) for axis in "xyzw"]
        good = (
            request.target_pose.header.frame_id == "odom"
            and all(math.isfinite(n) for n in (*numbers, request.max_velocity))
            and math.hypot(*numbers[3:]) > 0.5
            and request.max_velocity >= 0.0
        )
        ready = self.odom is not None and self.state is not None and self.state.motors_enabled
        free = self.current is None or not self.current.is_active
        return GoalResponse.ACCEPT if good and ready and free else GoalResponse.REJECT

    def on_accepted(self, goal_handle):
        self.current = goal_handle
        goal_handle.execute()

    async def sleep(self, seconds):
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        try:
            await done
        finally:
            self.destroy_timer(timer)

    async def execute(self, goal_handle):
        goal = goal_handle.request.target_pose.pose
        most = goal_handle.request.max_velocity or 0.3
        first_step = self.state.steps
        calm = 0
        rounds = 0
        while True:
            here = self.odom.pose.pose
            dx, dy = goal.position.x - here.position.x, goal.position.y - here.position.y
            heading = yaw_of(here.orientation)
            turn = wrap(yaw_of(goal.orientation) - heading)
            distance = math.hypot(dx, dy)

            if self.state.mode == RobotState.FALLEN:
                goal_handle.abort()
                return self.result(first_step, WalkTo.Result.FELL, "the robot fell")

            twist = Twist()
            if distance > 0.06 or abs(turn) > 0.08:
                calm = 0
                vx = dx * math.cos(heading) + dy * math.sin(heading)
                vy = dy * math.cos(heading) - dx * math.sin(heading)
                shrink = max(1.0, math.hypot(vx, vy) / most, abs(vy) / 0.12)
                twist.linear.x, twist.linear.y = vx / shrink, vy / shrink
                twist.angular.z = limit(turn, 0.4)
            else:
                speed = self.odom.twist.twist.linear
                calm = calm + 1 if math.hypot(speed.x, speed.y) < 0.03 else 0
            self.cmd_vel.publish(twist)
            if calm == 10:
                goal_handle.succeed()
                return self.result(first_step)

            if rounds % 4 == 0:
                feedback = WalkTo.Feedback(
                    current_pose=self.pose(),
                    distance_remaining=distance,
                    steps_taken=self.state.steps - first_step,
                )
                feedback.estimated_time_remaining.sec = round(distance / most)
                goal_handle.publish_feedback(feedback)
            rounds += 1
            await self.sleep(0.05)

    def pose(self):
        return PoseStamped(header=self.odom.header, pose=self.odom.pose.pose)

    def result(self, first_step, code=WalkTo.Result.NONE, message=""):
        return WalkTo.Result(
            error_code=code,
            error_msg=message,
            final_pose=self.pose(),
            total_steps=self.state.steps - first_step,
        )


def main(args=None):
    rclpy.init(args=args)
    node = WalkServer()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
