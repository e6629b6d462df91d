"""Style: functions and closures; one after the other it turns to the goal, walks straight ahead and turns to the heading,
with create_rate; a timer publishes feedback meanwhile; a lock that is only tried keeps goals apart.
"""

import math
import threading
from types import SimpleNamespace

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor

RATE = 20.0  # Hz


class Fell(Exception):
    """The robot lies on the floor."""


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.remainder(angle, math.tau)


def limit(value, most):
    return max(-most, min(most, value))


def is_sensible(request):
    p, q = request.target_pose.pose.position, request.target_pose.pose.orientation
    numbers = (p.x, p.y, p.z, q.x, q.y, q.z, q.w, request.max_velocity)
    return (
        request.target_pose.header.frame_id == "odom"
        and all(map(math.isfinite, numbers))
        and any((q.x, q.y, q.z, q.w))
        and request.max_velocity >= 0.0
    )


def make_server(node):
    robot = node.robot = SimpleNamespace(odom=None, state=None, rate=None)
    legs = threading.Lock()
    group = ReentrantCallbackGroup()
    cmd_vel = node.create_publisher(Twist, "cmd_vel", 10)

    def remember(name):
        return lambda message: setattr(robot, name, message)

    def on_goal(request):
        ready = robot.odom is not None and robot.state is not None and robot.state.motors_enabled
        if is_sensible(request) and ready and legs.acquire(blocking=False):
            return GoalResponse.ACCEPT
        return GoalResponse.REJECT

    def pose():
        return PoseStamped(header=robot.odom.header, pose=robot.odom.pose.pose)

    def way_to(goal):
        """Return distance (m), direction and heading (rad) of the goal as seen from the robot."""
        here = robot.odom.pose.pose
        dx, dy = goal.position.x - here.position.x, goal.position.y - here.position.y
        yaw = yaw_of(here.orientation)
        return math.hypot(dx, dy), wrap(math.atan2(dy, dx) - yaw), wrap(yaw_of(goal.orientation) - yaw)

    def drive(forward=0.0, left=0.0, turn=0.0):
        if robot.state.mode == RobotState.FALLEN:
            raise Fell
        command = Twist()
        command.linear.x, command.linear.y, command.angular.z = forward, left, limit(turn, 0.4)
        cmd_vel.publish(command)

    def execute(goal_handle):
        goal = goal_handle.request.target_pose.pose
        start = robot.state.steps

        def say_where():
            feedback = WalkTo.Feedback(current_pose=pose(), steps_taken=robot.state.steps - start)
            feedback.distance_remaining = way_to(goal)[0]
            most = goal_handle.request.max_velocity or 0.3
            feedback.estimated_time_remaining.sec = math.ceil(feedback.distance_remaining / most)
            goal_handle.publish_feedback(feedback)

        talking = node.create_timer(0.2, say_where, callback_group=group)
        result = WalkTo.Result()
        end = goal_handle.succeed
        try:
            walk(goal, goal_handle.request.max_velocity or 0.3)
        except Fell:
            end, result.error_code, result.error_msg = goal_handle.abort, WalkTo.Result.FELL, "it fell"
        finally:
            node.destroy_timer(talking)
            legs.release()
        result.final_pose = pose()
        result.total_steps = robot.state.steps - start
        end()
        return result

    def walk(goal, most):
        rate = robot.rate = node.create_rate(RATE)
        try:
            while True:
                distance, _, turn = way_to(goal)
                if distance < 0.08 and abs(turn) < 0.1:
                    return
                while way_to(goal)[0] > 0.05:
                    distance, direction, _ = way_to(goal)
                    if distance < 0.2:  # too near to turn: a small step, whichever way
                        ahead = min(0.5 * distance, most)
                        drive(ahead * math.cos(direction), ahead * math.sin(direction))
                    elif abs(direction) < 0.3:
                        drive(min(most, distance), turn=direction)
                    else:
                        drive(turn=direction)
                    rate.sleep()
                while abs(turn := way_to(goal)[2]) > 0.06:
                    drive(turn=turn)
                    rate.sleep()
                for _ in range(round(1.5 * RATE)):
                    drive()
                    rate.sleep()
        finally:
            node.destroy_rate(rate)

    node.create_subscription(Odometry, "odom", remember("odom"), 10, callback_group=group)
    node.create_subscription(RobotState, "robot_state", remember("state"), 10, callback_group=group)
    return ActionServer(node, WalkTo, "walk_to", execute, goal_callback=on_goal, callback_group=group)


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("walker")
    server = make_server(node)
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        if node.robot.rate:
            node.robot.rate.destroy()  # Ctrl-C does not wake a rate that sleeps
        executor.shutdown()
        server.destroy()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
