"""Style: one thread and a state machine: odom's callback drives, execute awaits the end; speed is measured."""

import math
import time
from dataclasses import dataclass, field
from enum import Enum

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

Result = NavigateToPose.Result
SWAY = 0.15  # m


class Phase(Enum):
    TURN = "turning"
    WALK = "walking"
    ALIGN = "aligning"
    STAND = "standing"


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    return (angle + math.pi) % (2 * math.pi) - math.pi


def clip(value, most):
    return min(most, max(-most, value))


@dataclass
class Trip:
    """One goal, from acceptance to its end."""

    handle: object
    accepted: float
    whole: float
    anchor: tuple
    phase: Phase = Phase.TURN
    walked: float = 0.0
    walking: float = 0.0
    recoveries: int = 0
    progress: float = 0.0
    calm: int = 0
    ticks: int = 0
    end: Future = field(default_factory=Future)


class NavigationMachine(Node):
    def __init__(self):
        super().__init__("navigation_machine")
        self.odom = self.state = self.trip = None
        self.ends = {}
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.create_subscription(RobotState, "robot_state", lambda message: setattr(self, "state", message), 10)
        self.server = ActionServer(
            self,
            NavigateToPose,
            "navigate_to_pose",
            execute_callback=self.execute,
            goal_callback=self.judge,
            handle_accepted_callback=self.begin,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )

    def judge(self, request):
        p, q = request.pose.pose.position, request.pose.pose.orientation
        numbers = (p.x, p.y, p.z, q.x, q.y, q.z, q.w, request.tolerance)
        if request.pose.header.frame_id != "odom" or not math.isfinite(sum(numbers)):
            return GoalResponse.REJECT
        if request.tolerance and not request.tolerance > 0.049:
            return GoalResponse.REJECT
        if self.odom is None or self.state is None or not self.state.motors_enabled:
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def begin(self, handle):
        if self.trip:
            self.finish("abort", Result.PREEMPTED, "a later goal took the robot")
        x, y = self.odom.pose.pose.position.x, self.odom.pose.pose.position.y
        goal = handle.request.pose.pose.position
        self.trip = Trip(handle, time.monotonic(), math.dist((x, y), (goal.x, goal.y)), (x, y))
        self.ends[bytes(handle.goal_id.uuid)] = self.trip.end
        handle.execute()

    async def execute(self, handle):
        verb, result = await self.ends.pop(bytes(handle.goal_id.uuid))
        getattr(handle, verb)()
        return result

    def finish(self, verb, code=Result.NONE, message=""):
        trip, self.trip = self.trip, None
        here = self.odom.pose.pose.position
        walked = trip.walked + math.dist((here.x, here.y), trip.anchor)
        trip.end.set_result((verb, Result(error_code=code, error_msg=message, distance_traveled=walked)))

    def on_odom(self, odom):
        self.odom = odom
        trip = self.trip
        if trip is None or self.state is None:
            return
        elapsed = time.monotonic() - trip.accepted
        if self.state.mode == RobotState.FALLEN:
            return self.finish("abort", Result.FELL, "fallen")
        if trip.handle.is_cancel_requested:
            self.cmd_vel.publish(Twist())
            return self.finish("canceled")
        if elapsed > 30.0 + 15.0 * trip.whole:
            self.cmd_vel.publish(Twist())
            return self.finish("abort", Result.TIMEOUT, f"not there in {elapsed:.0f} s")

        x, y = odom.pose.pose.position.x, odom.pose.pose.position.y
        if math.dist((x, y), trip.anchor) > SWAY:
            trip.walked += math.dist((x, y), trip.anchor)
            trip.anchor = x, y
        goal = trip.handle.request.pose.pose
        tolerance = trip.handle.request.tolerance or 0.10
        dx, dy = goal.position.x - x, goal.position.y - y
        heading = yaw_of(odom.pose.pose.orientation)
        distance, bearing = math.hypot(dx, dy), wrap(math.atan2(dy, dx) - heading)
        turn = wrap(yaw_of(goal.orientation) - heading)

        self.cmd_vel.publish(self.steer(trip, distance, bearing, turn, tolerance))
        if trip.phase is Phase.WALK:
            trip.walking += 0.05
        trip.progress = max(trip.progress, min(99.9, 100.0 - 100.0 * distance / (trip.whole + 0.01)))
        trip.ticks += 1
        if trip.calm > 14 and self.state.mode == RobotState.STANDING:
            trip.progress = 100.0
            self.tell(trip, distance, 0.0, elapsed)
            return self.finish("succeed")
        if trip.ticks % 4 == 1 and trip.handle.is_active:
            speed = trip.walked / trip.walking if trip.walking > 1.5 and trip.walked > 0.2 else 0.28
            seconds = distance / max(speed, 0.1) + 1.0
            seconds += abs(turn) / 0.4 if distance < 0.3 else (abs(bearing) + abs(wrap(turn - bearing))) / 0.4
            self.tell(trip, distance, seconds, elapsed)

    def steer(self, trip, distance, bearing, turn, tolerance):
        twist = Twist()
        slack = 0.9 if trip.phase is Phase.STAND else 0.5
        if distance < slack * tolerance and abs(turn) < (0.12 if trip.phase is Phase.STAND else 0.07):
            trip.phase = Phase.STAND
            trip.calm += 1
            return twist
        trip.calm = 0
        if distance < 0.3:
            trip.phase = Phase.ALIGN if distance < 0.6 * tolerance else Phase.WALK
            twist.linear.x = clip(0.9 * distance * math.cos(bearing), 0.2)
            twist.linear.y = clip(0.9 * distance * math.sin(bearing), 0.1)
            twist.angular.z = clip(0.9 * turn, 0.4)
            return twist
        if trip.phase is Phase.WALK and abs(bearing) > 0.5:
            trip.recoveries += 1
            trip.phase = Phase.TURN
        elif trip.phase is not Phase.WALK and abs(bearing) < 0.2:
            trip.phase = Phase.WALK
        twist.angular.z = clip(1.4 * bearing, 0.4)
        if trip.phase is Phase.WALK:
            twist.linear.x = clip(0.9 * distance, 0.33)
        return twist

    def tell(self, trip, distance, seconds, elapsed):
        trip.handle.publish_feedback(
            NavigateToPose.Feedback(
                status=trip.phase.value,
                current_pose=PoseStamped(header=self.odom.header, pose=self.odom.pose.pose),
                navigation_time=Duration(seconds=elapsed).to_msg(),
                estimated_time_remaining=Duration(seconds=seconds).to_msg(),
                number_of_recoveries=trip.recoveries,
                distance_remaining=distance,
                progress_percentage=trip.progress,
            )
        )


def main(args=None):
    rclpy.init(args=args)
    executor = SingleThreadedExecutor()
    node = NavigationMachine()
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
