"""Style: one thread; an async execute callback that awaits one-shot timers; the path is a mean over the last second."""

import math
from collections import deque

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    return max(-most, min(most, value))


class Navigator(Node):
    def __init__(self):
        super().__init__("navigator")
        self.odom = None
        self.state = None
        self.newest = None
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 1)
        self.create_subscription(Odometry, "odom", self.on_odom, 1)
        self.create_subscription(RobotState, "robot_state", self.on_state, 1)
        self.server = ActionServer(
            self,
            NavigateToPose,
            "navigate_to_pose",
            self.execute,
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=self.on_cancel,
        )

    def on_odom(self, odom):
        self.odom = odom

    def on_state(self, state):
        self.state = state

    def on_goal(self, request):
        p, q = request.pose.pose.position, request.pose.pose.orientation
        finite = all(math.isfinite(n) for n in (p.x, p.y, p.z, q.x, q.y, q.z, q.w, request.tolerance))
        possible = request.tolerance == 0 or request.tolerance >= 0.05
        ready = self.odom is not None and self.state is not None and self.state.motors_enabled
        if request.pose.header.frame_id == "odom" and finite and possible and ready:
            return GoalResponse.ACCEPT
        return GoalResponse.REJECT

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def on_accepted(self, goal_handle):
        self.newest = goal_handle
        goal_handle.execute()

    async def sleep(self, seconds):
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        try:
            await done
        finally:
            self.destroy_timer(timer)

    async def execute(self, goal_handle):
        clock = self.get_clock()
        accepted = clock.now()
        goal = goal_handle.request.pose.pose
        tolerance = goal_handle.request.tolerance or 0.1
        position = self.odom.pose.pose.position
        first = max(math.hypot(goal.position.x - position.x, goal.position.y - position.y), 1e-3)
        lately = deque([(position.x, position.y)], maxlen=20)
        middle = (position.x, position.y)
        traveled = progress = 0.0
        recoveries = rounds = calm = 0
        status = "rotating"
        feedback = NavigateToPose.Feedback()
        result = NavigateToPose.Result()
        while True:
            here = self.odom.pose.pose
            lately.append((here.position.x, here.position.y))
            mean = tuple(sum(values) / len(lately) for values in zip(*lately))
            traveled += math.dist(middle, mean)
            middle = mean
            result.distance_traveled = traveled

            dx, dy = goal.position.x - here.position.x, goal.position.y - here.position.y
            distance = math.hypot(dx, dy)
            heading = yaw_of(here.orientation)
            bearing = wrap(math.atan2(dy, dx) - heading)
            turn = wrap(yaw_of(goal.orientation) - heading)
            elapsed = (clock.now() - accepted).nanoseconds * 1e-9

            if goal_handle is not self.newest:
                result.error_code, result.error_msg = NavigateToPose.Result.PREEMPTED, "another goal came"
                goal_handle.abort()
                return result
            if self.state.mode == RobotState.FALLEN:
                result.error_code, result.error_msg = NavigateToPose.Result.FELL, "the robot fell"
                goal_handle.abort()
                return result
            if goal_handle.is_cancel_requested:
                self.cmd_vel.publish(Twist())
                goal_handle.canceled()
                return result
            if elapsed > 30 + 15 * first:
                self.cmd_vel.publish(Twist())
                result.error_code, result.error_msg = NavigateToPose.Result.TIMEOUT, "too slow"
                goal_handle.abort()
                return result

            twist = Twist()
            if distance < 0.5 * tolerance and abs(turn) < 0.07 or calm and distance < 0.9 * tolerance and abs(turn) < 0.12:
                status = "at the goal"
                calm += 1
            elif distance < (0.3 if status in ("rotating", "driving") else 0.5):  # it sways: once near, it stays so
                calm = 0
                status = "rotating to the goal's heading" if distance < 0.5 * tolerance else "driving the last steps"
                twist.linear.x = limit(distance * math.cos(bearing), 0.2)
                twist.linear.y = limit(distance * math.sin(bearing), 0.1)
                twist.angular.z = limit(turn, 0.4)
            else:
                calm = 0
                if status.startswith("driving") and abs(bearing) > 0.5:
                    recoveries += 1
                    status = "rotating"
                if status == "rotating" and abs(bearing) < 0.2:
                    status = "driving"
                elif status not in ("rotating", "driving"):
                    status = "driving"
                twist.angular.z = limit(1.5 * bearing, 0.4)
                if status == "driving":
                    twist.linear.x = 0.35 * math.cos(bearing)
            self.cmd_vel.publish(twist)

            arrived = calm == 20 and self.state.mode == RobotState.STANDING
            calm = min(calm, 19)
            progress = 100.0 if arrived else max(progress, min(99.0, 100 * (1 - distance / first)))
            if arrived or rounds % 4 == 0:
                feedback.status = status
                feedback.current_pose = PoseStamped(header=self.odom.header, pose=here)
                feedback.navigation_time = Duration(seconds=elapsed).to_msg()
                seconds = distance / 0.3 + (abs(bearing) + abs(wrap(turn - bearing))) / 0.4 + 1
                feedback.estimated_time_remaining = Duration(seconds=seconds).to_msg()
                feedback.number_of_recoveries = recoveries
                feedback.distance_remaining = distance
                feedback.progress_percentage = progress
                goal_handle.publish_feedback(feedback)
            if arrived:
                goal_handle.succeed()
                return result
            rounds += 1
            await self.sleep(0.05)


def main(args=None):
    rclpy.init(args=args)
    node = Navigator()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
