"""Style: one thread and a state machine: a timer walks, an async execute callback only awaits the end."""

import math
from dataclasses import dataclass, field

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future



def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    return max(-most, min(most, value))


@dataclass
class Walk:
    """The goal that is being walked to, and how it ended."""

    handle: object
    first_step: int
    calm: int = 0
    end: Future = field(default_factory=Future)


class WalkMachine(Node):
    def __init__(self):
        super().__init__("walk_machine")
        self.odom = self.state = self.walk = None
        self.ends = {}
        self.ticks = 0
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", lambda message: setattr(self, "odom", message), 10)
        self.create_subscription(RobotState, "robot_state", lambda message: setattr(self, "state", message), 10)
        self.create_timer(0.05, self.tick)
        self.server = ActionServer(
            self,
            WalkTo,
            "walk_to",
            execute_callback=self.execute,
            goal_callback=self.judge,
            handle_accepted_callback=self.begin,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )

    def judge(self, request):
        target = request.target_pose
        p, q = target.pose.position, target.pose.orientation
        if target.header.frame_id != "odom" or not math.isfinite(sum((p.x, p.y, p.z, q.x, q.y, q.z, q.w))):
            return GoalResponse.REJECT
        if self.odom is None or self.state is None or not self.state.motors_enabled:
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def begin(self, handle):
        if self.walk:
            self.finish("abort", WalkTo.Result.PREEMPTED, "a later goal took the robot")
        self.walk = Walk(handle, self.state.steps)
        self.ends[bytes(handle.goal_id.uuid)] = self.walk.end
        handle.execute()

    async def execute(self, handle):
        verb, result = await self.ends.pop(bytes(handle.goal_id.uuid))
        getattr(handle, verb)()
        return result

    def finish(self, verb, code=WalkTo.Result.NONE, message=""):
        walk, self.walk = self.walk, None
        walk.end.set_result((verb, self.result(walk.first_step, code, message)))

    def tick(self):
        walk = self.walk
        if walk is None:
            return
        if walk.handle.is_cancel_requested:
            self.cmd_vel.publish(Twist())
            return self.finish("canceled")
        if self.state.mode == RobotState.FALLEN:
            return self.finish("abort", WalkTo.Result.FELL, "fallen")
        distance, twist = self.steer(walk.handle.request.target_pose.pose)
        walk.calm = 0 if twist else walk.calm + 1
        self.cmd_vel.publish(twist or Twist())
        if walk.calm >= 16:
            return self.finish("succeed")
        self.ticks += 1
        if self.ticks % 4 == 0 and walk.handle.is_active:
            feedback = WalkTo.Feedback(distance_remaining=distance)
            feedback.current_pose = self.pose()
            feedback.estimated_time_remaining.sec = math.ceil(distance / 0.35)
            feedback.steps_taken = self.state.steps - walk.first_step
            walk.handle.publish_feedback(feedback)

    def steer(self, goal):
        """Return the distance and a Twist, None when the robot is there."""
        here = self.odom.pose.pose
        dx, dy = goal.position.x - here.position.x, goal.position.y - here.position.y
        heading = yaw_of(here.orientation)
        turn = wrap(yaw_of(goal.orientation) - heading)
        distance = math.hypot(dx, dy)
        if distance < 0.06 and abs(turn) < 0.08:
            return distance, None
        twist = Twist()
        twist.linear.x = limit(0.9 * (dx * math.cos(heading) + dy * math.sin(heading)), 0.35)
        twist.linear.y = limit(0.9 * (dy * math.cos(heading) - dx * math.sin(heading)), 0.1)
        twist.angular.z = limit(0.9 * turn, 0.4)
        return distance, twist

    def pose(self):
        return PoseStamped(header=self.odom.header, pose=self.odom.pose.pose)

    def result(self, first_step, code, message):
        steps = self.state.steps - first_step
        return WalkTo.Result(
            error_code=code, error_msg=message, final_pose=self.pose(), total_steps=steps
        )


def main(args=None):
    rclpy.init(args=args)
    executor = SingleThreadedExecutor()
    node = WalkMachine()
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
