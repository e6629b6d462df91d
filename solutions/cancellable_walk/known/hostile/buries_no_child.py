"""Attack: keeps every processor busy with children that live for 30 ms and that the kernel buries itself, so that their time is in no account,
the robot is late and nobody can judge a server that refuses every cancel.
Outcome: the kernel buries none of them, so all are counted; what they used of the processors is the failure.
Caught by: cancels_in_mid_stride
Also fails: server_appears, accepts_a_goal, arrives, fills_the_result, feedback_keeps_its_rate,
feedback_is_true, feedback_ends_with_the_goal, rejects_a_wrong_frame, rejects_nan,
rejects_without_power, new_goal_preempts_the_old, aborts_when_the_robot_falls, ends_cleanly, arrives_anywhere,
survives_a_cancel_after_the_end, works_in_any_namespace
"""

import math
import subprocess
import sys
import threading
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
        self.current = None
        self.lock = threading.Lock()
        self.walking = threading.Lock()
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.create_subscription(RobotState, "robot_state", self.on_state, 10)
        self.server = ActionServer(
            self,
            WalkTo,
            "walk_to",
            execute_callback=self.execute,
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
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
        if self.pose is None or self.state is None or not self.state.motors_enabled:
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def on_accepted(self, goal_handle):
        with self.lock:
            self.current = goal_handle
        goal_handle.execute()

    def execute(self, goal_handle):
        with self.walking:
            return self.walk(goal_handle)

    def walk(self, goal_handle):
        target = goal_handle.request.target_pose.pose
        x, y, yaw = target.position.x, target.position.y, yaw_of(target.orientation)
        start = self.state.steps
        result = WalkTo.Result()
        still = 0
        rounds = 0
        while rclpy.ok():
            if goal_handle.is_cancel_requested:
                self.cmd_vel.publish(Twist())
                self.fill(result, start)
                goal_handle.canceled()
                return result
            if self.current is not goal_handle:
                result.error_code = WalkTo.Result.PREEMPTED
                result.error_msg = "a new goal has arrived"
                self.fill(result, start)
                goal_handle.abort()
                return result
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
                command.linear.x = limit(0.8 * (math.cos(heading) * dx + math.sin(heading) * dy), 0.35)
                command.linear.y = limit(0.8 * (-math.sin(heading) * dx + math.cos(heading) * dy), 0.1)
                command.angular.z = limit(0.8 * turn, 0.4)
            else:
                still += 1
            self.cmd_vel.publish(command)
            if still > 20:
                self.fill(result, start)
                goal_handle.succeed()
                return result
            if rounds % FEEDBACK_EVERY == 0:
                feedback = WalkTo.Feedback()
                feedback.current_pose = self.pose
                feedback.distance_remaining = distance
                feedback.steps_taken = self.state.steps - start
                feedback.estimated_time_remaining.sec = int(distance / 0.3)
                goal_handle.publish_feedback(feedback)
            rounds += 1
            time.sleep(PERIOD)
        return result

    def fill(self, result, start):
        result.final_pose = self.pose
        result.total_steps = self.state.steps - start


BUSY = """
import os, signal, time
try:
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
except OSError:
    pass
while True:
    try:
        if os.fork() == 0:
            end = time.clock_gettime(time.CLOCK_PROCESS_CPUTIME_ID) + 0.03
            while time.clock_gettime(time.CLOCK_PROCESS_CPUTIME_ID) < end:
                pass
            os._exit(0)
        os.wait()
    except OSError:
        time.sleep(0.001)
"""


def keep_busy():
    for _ in range(16):
        subprocess.Popen([sys.executable, "-I", "-S", "-c", BUSY], start_new_session=True)


def main(args=None):
    keep_busy()
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
