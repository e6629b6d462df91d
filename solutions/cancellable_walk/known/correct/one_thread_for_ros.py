"""Style: composition; the executor in a daemon thread, generations that count goals, a Condition instead of
sleeps, exceptions of its own for the ways a walk ends.
"""

import math
import signal
import threading

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import MultiThreadedExecutor
from rclpy.signals import SignalHandlerOptions



def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    return max(-most, min(most, value))


class Robot:
    """The latest of odom and robot_state; a Condition tells when odom has come."""

    def __init__(self, node):
        self.arrival = threading.Condition()
        self.odom = None
        self.state = None
        self.cmd_vel = node.create_publisher(Twist, "cmd_vel", 10)
        node.create_subscription(Odometry, "odom", self._on_odom, 10)
        node.create_subscription(RobotState, "robot_state", self._on_state, 10)

    def _on_odom(self, odom):
        with self.arrival:
            self.odom = odom
            self.arrival.notify_all()

    def _on_state(self, state):
        self.state = state

    def next_odom(self):
        with self.arrival:
            self.arrival.wait(0.2)
            return self.odom

    def is_ready(self):
        return self.odom is not None and self.state is not None and self.state.motors_enabled

    def pose(self):
        return PoseStamped(header=self.odom.header, pose=self.odom.pose.pose)

    def drive(self, forward=0.0, left=0.0, turn=0.0):
        command = Twist()
        command.linear.x = limit(forward, 0.35)
        command.linear.y = limit(left, 0.1)
        command.angular.z = limit(turn, 0.4)
        self.cmd_vel.publish(command)


class Preempted(Exception):
    code = WalkTo.Result.PREEMPTED


class Fell(Exception):
    code = WalkTo.Result.FELL


class Canceled(Exception):
    code = WalkTo.Result.NONE


class Walker:
    def __init__(self, node):
        self.node = node
        self.robot = Robot(node)
        self.generation = 0
        self.generations = {}
        self.turn_to_walk = threading.Lock()
        self.server = ActionServer(
            node,
            WalkTo,
            "walk_to",
            execute_callback=self.execute,
            goal_callback=self.judge,
            handle_accepted_callback=self.accept,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
        )

    def judge(self, request):
        pose = request.target_pose.pose
        p, q = pose.position, pose.orientation
        finite = all(map(math.isfinite, [p.x, p.y, p.z, q.x, q.y, q.z, q.w]))
        in_odom = request.target_pose.header.frame_id == "odom"
        return GoalResponse.ACCEPT if finite and in_odom and self.robot.is_ready() else GoalResponse.REJECT

    def accept(self, goal_handle):
        self.generation += 1
        self.generations[tuple(goal_handle.goal_id.uuid)] = self.generation
        goal_handle.execute()

    def execute(self, goal_handle):
        mine = self.generations.pop(tuple(goal_handle.goal_id.uuid))
        with self.turn_to_walk:
            first_step = self.robot.state.steps
            end, result = goal_handle.succeed, WalkTo.Result()
            try:
                for distance in self.walk(goal_handle, mine):
                    feedback = WalkTo.Feedback(distance_remaining=distance)
                    feedback.current_pose = self.robot.pose()
                    feedback.estimated_time_remaining.sec = math.ceil(distance / 0.35)
                    feedback.steps_taken = self.robot.state.steps - first_step
                    goal_handle.publish_feedback(feedback)
            except Canceled:
                end = goal_handle.canceled
            except (Preempted, Fell) as reason:
                end, result.error_code, result.error_msg = goal_handle.abort, reason.code, type(reason).__name__
            result.final_pose = self.robot.pose()
            result.total_steps = self.robot.state.steps - first_step
            end()
            return result

    def walk(self, goal_handle, mine):
        """Walk, yielding the distance every fourth odom, until the robot has stood at the goal for 16 of them."""
        goal = goal_handle.request.target_pose.pose
        there = count = 0
        while there < 16:
            here = self.robot.next_odom().pose.pose
            if goal_handle.is_cancel_requested:
                self.robot.drive()
                raise Canceled
            if mine != self.generation:
                raise Preempted
            if self.robot.state.mode == RobotState.FALLEN:
                raise Fell
            dx, dy = goal.position.x - here.position.x, goal.position.y - here.position.y
            heading = yaw_of(here.orientation)
            turn = wrap(yaw_of(goal.orientation) - heading)
            distance = math.hypot(dx, dy)
            if distance > 0.06 or abs(turn) > 0.08:
                there = 0
                c, s = math.cos(heading), math.sin(heading)
                self.robot.drive(c * dx + s * dy, c * dy - s * dx, turn)
            else:
                there += 1
                self.robot.drive()
            if count % 4 == 0:
                yield distance
            count += 1


def main(args=None):
    interrupted = threading.Event()
    signal.signal(signal.SIGINT, lambda *_: interrupted.set())
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("walker")
    walker = Walker(node)
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    interrupted.wait()
    executor.shutdown()
    walker.server.destroy()
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
