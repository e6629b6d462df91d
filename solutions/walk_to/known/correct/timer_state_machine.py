"""Style: one thread and a state machine: a timer walks, settles and measures; an async execute only awaits the end."""

import math
from dataclasses import dataclass, field
from enum import Enum, auto

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, GoalResponse
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.task import Future

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def limit(value, most):
    return max(-most, min(most, value))


class Phase(Enum):
    WALKING = auto()
    SETTLING = auto()


@dataclass
class Walk:
    """The goal that is being walked to, and how it ended."""

    handle: object
    first_step: int
    phase: Phase = Phase.WALKING
    ticks: int = 0  # in this phase
    end: Future = field(default_factory=Future)


class WalkMachine(Node):
    def __init__(self):
        super().__init__("walk_machine")
        self.odom = self.state = self.walk = None
        self.ticks = 0
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(
            Odometry, "odom", lambda message: setattr(self, "odom", message), qos_profile_sensor_data
        )
        self.create_subscription(
            RobotState, "robot_state", lambda message: setattr(self, "state", message), LATCHED
        )
        self.create_timer(0.05, self.tick)
        self.server = ActionServer(
            self,
            WalkTo,
            "walk_to",
            execute_callback=self.execute,
            goal_callback=self.judge,
            handle_accepted_callback=self.begin,
        )

    def judge(self, request):
        target = request.target_pose
        p, q = target.pose.position, target.pose.orientation
        length = q.x**2 + q.y**2 + q.z**2 + q.w**2
        objections = (
            target.header.frame_id != "odom",
            not math.isfinite(p.x + p.y + p.z + length + request.max_velocity),
            length < 0.01,
            request.max_velocity < 0.0,
            self.odom is None,
            self.state is None or not self.state.motors_enabled,
            self.walk is not None,
        )
        return GoalResponse.REJECT if any(objections) else GoalResponse.ACCEPT

    def begin(self, handle):
        self.walk = Walk(handle, self.state.steps)
        handle.execute()

    async def execute(self, handle):
        verb, result = await self.walk.end
        getattr(handle, verb)()
        return result

    def finish(self, verb, code=WalkTo.Result.NONE, message=""):
        walk, self.walk = self.walk, None
        steps = self.state.steps - walk.first_step
        result = WalkTo.Result(error_code=code, error_msg=message, final_pose=self.pose(), total_steps=steps)
        walk.end.set_result((verb, result))

    def enter(self, phase):
        self.walk.phase, self.walk.ticks = phase, 0

    def tick(self):
        walk = self.walk
        if walk is None:
            return
        if self.state.mode == RobotState.FALLEN:
            return self.finish("abort", WalkTo.Result.FELL, "fallen")
        walk.ticks += 1
        forward, left, turn = self.way_to(walk.handle.request.target_pose.pose)
        distance = math.hypot(forward, left)
        if walk.phase is Phase.WALKING:
            if distance < 0.06 and abs(turn) < 0.08:
                self.enter(Phase.SETTLING)
                self.cmd_vel.publish(Twist())
            else:
                self.steer(forward, left, turn, walk.handle.request.max_velocity or 0.35)
        else:
            if self.state.mode != RobotState.STANDING:
                walk.ticks = 0
            if walk.ticks > 12:  # 0.6 s on both feet
                if distance < 0.08 and abs(turn) < 0.12:
                    return self.finish("succeed")
                self.enter(Phase.WALKING)
        self.ticks += 1
        if self.ticks % 4 == 0:
            feedback = WalkTo.Feedback(distance_remaining=distance)
            feedback.current_pose = self.pose()
            feedback.estimated_time_remaining.sec = math.ceil(distance / (walk.handle.request.max_velocity or 0.35))
            feedback.steps_taken = self.state.steps - walk.first_step
            walk.handle.publish_feedback(feedback)

    def way_to(self, goal):
        here = self.odom.pose.pose
        dx, dy = goal.position.x - here.position.x, goal.position.y - here.position.y
        heading = yaw_of(here.orientation)
        turn = (yaw_of(goal.orientation) - heading + math.pi) % (2 * math.pi) - math.pi
        forward = dx * math.cos(heading) + dy * math.sin(heading)
        return forward, dy * math.cos(heading) - dx * math.sin(heading), turn

    def steer(self, forward, left, turn, most):
        speed = min(most, math.hypot(forward, left), 0.12 * math.hypot(forward, left) / max(abs(left), 1e-6))
        direction = math.atan2(left, forward)
        twist = Twist()
        twist.linear.x = speed * math.cos(direction)
        twist.linear.y = speed * math.sin(direction)
        twist.angular.z = limit(0.9 * turn, 0.4)
        self.cmd_vel.publish(twist)

    def pose(self):
        return PoseStamped(header=self.odom.header, pose=self.odom.pose.pose)


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
