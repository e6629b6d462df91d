"""Style: functions and closures; create_rate in execute on a MultiThreadedExecutor, feedback by a timer of its own
that is destroyed at the end.
"""

import math
import threading
from types import SimpleNamespace

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor

RATE = 20.0



def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    return max(-most, min(most, value))


def error_to(goal, odom):
    """Return distance, forward, left (m) and turn (rad) from the robot to the goal."""
    here = odom.pose.pose
    dx, dy = goal.position.x - here.position.x, goal.position.y - here.position.y
    heading = yaw_of(here.orientation)
    forward = math.cos(heading) * dx + math.sin(heading) * dy
    left = math.cos(heading) * dy - math.sin(heading) * dx
    return math.hypot(dx, dy), forward, left, wrap(yaw_of(goal.orientation) - heading)


def make_server(node):
    robot = node.robot = SimpleNamespace(odom=None, state=None, rate=None)
    goals = SimpleNamespace(newest=None)
    one_at_a_time = threading.Lock()
    group = ReentrantCallbackGroup()
    cmd_vel = node.create_publisher(Twist, "cmd_vel", 10)

    def remember(name):
        return lambda message: setattr(robot, name, message)

    def on_goal(request):
        pose = request.target_pose.pose
        p, q = pose.position, pose.orientation
        checks = (
            request.target_pose.header.frame_id == "odom",
            all(math.isfinite(value) for value in (p.x, p.y, p.z, q.x, q.y, q.z, q.w)),
            robot.odom is not None,
            robot.state is not None and robot.state.motors_enabled,
        )
        return GoalResponse.ACCEPT if all(checks) else GoalResponse.REJECT

    def on_accepted(goal_handle):
        goals.newest = goal_handle
        goal_handle.execute()

    def pose():
        return PoseStamped(header=robot.odom.header, pose=robot.odom.pose.pose)

    def execute(goal_handle):
        with one_at_a_time:
            goal = goal_handle.request.target_pose.pose
            start = robot.state.steps

            def say_where():
                feedback = WalkTo.Feedback(current_pose=pose(), steps_taken=robot.state.steps - start)
                feedback.distance_remaining = error_to(goal, robot.odom)[0]
                feedback.estimated_time_remaining.sec = math.ceil(feedback.distance_remaining / 0.3)
                goal_handle.publish_feedback(feedback)

            talking = node.create_timer(0.2, say_where, callback_group=group)
            try:
                end, code, message = walk(goal_handle, goal)
            finally:
                node.destroy_timer(talking)
            result = WalkTo.Result(error_code=code, error_msg=message)
            result.final_pose = pose()
            result.total_steps = robot.state.steps - start
            end()
            return result

    def walk(goal_handle, goal):
        rate = robot.rate = node.create_rate(RATE)
        near_since = 0
        try:
            while True:
                if goal_handle.is_cancel_requested:
                    cmd_vel.publish(Twist())
                    return goal_handle.canceled, WalkTo.Result.NONE, ""
                if goals.newest is not goal_handle:
                    return goal_handle.abort, WalkTo.Result.PREEMPTED, "a newer goal"
                if robot.state.mode == RobotState.FALLEN:
                    return goal_handle.abort, WalkTo.Result.FELL, "it fell"
                distance, forward, left, turn = error_to(goal, robot.odom)
                command = Twist()
                if distance > 0.05 or abs(turn) > 0.08:
                    near_since = 0
                    command.linear.x, command.linear.y = limit(forward, 0.3), limit(left, 0.1)
                    command.angular.z = limit(turn, 0.4)
                else:
                    near_since += 1
                cmd_vel.publish(command)
                if near_since > RATE:
                    return goal_handle.succeed, WalkTo.Result.NONE, ""
                rate.sleep()
        finally:
            rate.destroy()

    node.create_subscription(Odometry, "odom", remember("odom"), 5, callback_group=group)
    node.create_subscription(RobotState, "robot_state", remember("state"), 5, callback_group=group)
    return ActionServer(
        node,
        WalkTo,
        "walk_to",
        execute,
        callback_group=group,
        goal_callback=on_goal,
        handle_accepted_callback=on_accepted,
        cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
    )


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("walker")
    make_server(node)
    executor = MultiThreadedExecutor(num_threads=6)
    try:
        rclpy.spin(node, executor)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        if node.robot.rate:
            node.robot.rate.destroy()  # Ctrl-C does not wake a rate that sleeps
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
