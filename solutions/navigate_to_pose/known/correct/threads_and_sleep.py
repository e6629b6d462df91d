"""Style: as in the notebook: a class, MultiThreadedExecutor and time.sleep in the execute callback."""

import math
import threading
import time

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

CONTROL_PERIOD = 0.05  # s, as long as odom's
FEEDBACK_PERIOD = 0.2  # s
WALK_VELOCITY, SIDEWAYS_VELOCITY = 0.35, 0.12  # m/s
TURN_VELOCITY = 0.4  # rad/s
GAIN = 0.8  # 1/s, velocity for each metre or radian still to go
DEFAULT_TOLERANCE, SMALLEST_TOLERANCE = 0.10, 0.05  # m
STOP_TURN, ARRIVED_TURN = 0.07, 0.12  # rad: where to stop, and where to stay once it stands
FACING, OFF_THE_WAY = 0.15, 0.5  # rad between heading and goal: good enough to walk, bad enough to turn first
NEAR = 0.3  # m; nearer than this the robot steps to the goal in any direction and need not face it
STANDING_TIME = 0.5  # s without a step, after which the robot counts as still
LEG = 0.15  # m; shorter moves may be the pelvis's sway and are not counted

TURNING, WALKING, ALIGNING, STOPPING = "turning to the goal", "walking", "turning to the heading", "stopping"


def yaw_of(orientation):
    """Return the rotation (rad) about z of a quaternion."""
    q = orientation
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def wrap(angle):
    """Return the same angle (rad) between -pi and pi."""
    return math.atan2(math.sin(angle), math.cos(angle))


def limit(value, most):
    """Return the value, at most `most` in either direction."""
    return max(-most, min(most, value))


def twist(forward, left, turn):
    """Return a Twist of m/s, m/s, rad/s, within what the robot can do and without changing its direction."""
    excess = max(math.hypot(forward, left) / WALK_VELOCITY, abs(left) / SIDEWAYS_VELOCITY, 1.0)
    command = Twist()
    command.linear.x, command.linear.y = forward / excess, left / excess
    command.angular.z = limit(turn, TURN_VELOCITY)
    return command


class Journey:
    """What is to be told of one goal: its start, the path so far, the phase. It knows nothing of ROS."""

    def __init__(self, now, x, y, distance):
        self.started = now
        self.time_limit = 30.0 + 15.0 * distance  # s
        self.phase = TURNING
        self.recoveries = 0
        self.traveled = 0.0  # m
        self.progress = 0.0
        self._longest = None  # s that were left at first
        self._counted = x, y  # the path is counted up to here

    def count(self, x, y, shortest=LEG):
        """Count the way to (x, y), but only legs that are no sway; at the end, when it stands, whatever is left."""
        leg = math.hypot(x - self._counted[0], y - self._counted[1])
        if leg >= shortest:
            self.traveled += leg
            self._counted = x, y

    def time_left(self, distance, bearing, turn):
        """Estimate the time (s) left: to turn to the goal, to walk there, to turn to the heading, to stand."""
        last_turn = wrap(turn - bearing) if distance > NEAR else turn  # on the way the robot faces the goal
        first_turn = bearing if distance > NEAR else 0.0
        turns = (abs(first_turn) + abs(last_turn)) / TURN_VELOCITY
        return turns + distance / (0.85 * WALK_VELOCITY) + 2 * STANDING_TIME

    def advance(self, time_left):
        """Raise the progress (percent) by the time that is left; it never falls, and 100 is kept for the end."""
        self._longest = self._longest or time_left
        self.progress = max(self.progress, min(99.0, 100.0 * (1.0 - time_left / self._longest)))


class NavigationServer(Node):
    def __init__(self):
        super().__init__("navigation_server")
        self._pose = None  # PoseStamped: base_link in odom
        self._state = None  # RobotState
        self._latest = None  # the goal that has the robot; an older one gives way
        self._legs = threading.Lock()  # held by the goal that walks
        self._cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", self._on_odom, 10)
        self.create_subscription(RobotState, "robot_state", self._on_robot_state, LATCHED)
        self._server = ActionServer(
            self,
            NavigateToPose,
            "navigate_to_pose",
            execute_callback=self._execute,
            goal_callback=self._on_goal,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=self._on_cancel,
        )

    def _on_odom(self, message):
        self._pose = PoseStamped(header=message.header, pose=message.pose.pose)

    def _on_robot_state(self, message):
        self._state = message

    def _way_to(self, target):
        """Return what is left as seen from base_link: distance (m), bearing of the goal (rad), turn to its yaw (rad)."""
        here = self._pose.pose
        x, y = target.position.x - here.position.x, target.position.y - here.position.y
        heading = yaw_of(here.orientation)
        return math.hypot(x, y), wrap(math.atan2(y, x) - heading), wrap(yaw_of(target.orientation) - heading)

    def _on_goal(self, request):
        """Step 1: reject what can be known to be impossible before the robot moves."""
        if objection := self._objection(request):
            self.get_logger().warning(f"goal rejected: {objection}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _on_accepted(self, goal_handle):
        """Step 8: let the newest goal have the robot."""
        self._latest = goal_handle
        goal_handle.execute()

    def _execute(self, goal_handle):
        """Steps 2 to 8: drive until the goal is reached or given up, fill the result, make one terminal call."""
        result = NavigateToPose.Result()
        here = self._pose.pose.position
        distance, _bearing, _turn = self._way_to(goal_handle.request.pose.pose)
        journey = Journey(time.monotonic(), here.x, here.y, distance)  # since acceptance, before the lock
        with self._legs:
            finish, result.error_code, result.error_msg = self._drive(goal_handle, journey)
            here = self._pose.pose.position
            journey.count(here.x, here.y, shortest=0.0)
            result.distance_traveled = journey.traveled
            if rclpy.ok():
                finish()
        return result

    def _objection(self, request):
        """Return why a goal cannot be reached, or nothing."""
        frame, pose = request.pose.header.frame_id, request.pose.pose
        p, q = pose.position, pose.orientation
        if frame != "odom":
            return f"the pose is in frame {frame!r}, not in 'odom'"
        if not all(map(math.isfinite, (p.x, p.y, p.z, q.x, q.y, q.z, q.w, request.tolerance))):
            return "it holds a number that is not finite"
        if math.hypot(q.x, q.y, q.z, q.w) < 0.5:
            return "its orientation is not a rotation"
        if request.tolerance != 0.0 and request.tolerance < SMALLEST_TOLERANCE:
            return f"a tolerance of {request.tolerance:.3f} m is below {SMALLEST_TOLERANCE} m"
        if self._pose is None or self._state is None:
            return "the robot has not been heard yet"
        if not self._state.motors_enabled or self._state.mode == RobotState.FALLEN:
            return "the robot cannot walk"
        return ""

    def _on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def _drive(self, goal_handle, journey):
        """Bring the robot there; return the terminal call to make, the error code and a message for people."""
        request = goal_handle.request
        tolerance = request.tolerance or DEFAULT_TOLERANCE
        feedback_due = journey.started
        stopped_since = None
        none = NavigateToPose.Result.NONE
        while rclpy.ok():
            now = time.monotonic()
            if self._state.mode in (RobotState.FALLEN, RobotState.OFF):
                return goal_handle.abort, NavigateToPose.Result.FELL, "the robot fell"
            if self._latest is not goal_handle:
                return goal_handle.abort, NavigateToPose.Result.PREEMPTED, "a later goal took the robot"
            here = self._pose.pose.position
            distance, bearing, turn = self._way_to(request.pose.pose)
            journey.count(here.x, here.y)
            time_left = journey.time_left(distance, bearing, turn)
            journey.advance(time_left)

            is_late = now - journey.started > journey.time_limit
            share = 0.5 if stopped_since is None else 0.9  # stop nearer than it has to stay
            nearest = STOP_TURN if stopped_since is None else ARRIVED_TURN
            is_there = distance < share * tolerance and abs(turn) < nearest
            if goal_handle.is_cancel_requested or is_late or is_there:
                journey.phase = STOPPING
                self._cmd_vel.publish(Twist())
                if stopped_since is None or self._state.mode != RobotState.STANDING:
                    stopped_since = now
                elif now - stopped_since > STANDING_TIME:
                    if goal_handle.is_cancel_requested:
                        return goal_handle.canceled, none, ""
                    if is_there:
                        journey.progress = 100.0
                        self._publish_feedback(goal_handle, journey, distance, 0.0)
                        return goal_handle.succeed, none, ""
                    late = f"not there after {journey.time_limit:.0f} s"
                    return goal_handle.abort, NavigateToPose.Result.TIMEOUT, late
            else:
                stopped_since = None
                self._cmd_vel.publish(self._steer(journey, distance, bearing, turn, 0.5 * tolerance))

            if now >= feedback_due:
                feedback_due += FEEDBACK_PERIOD
                self._publish_feedback(goal_handle, journey, distance, time_left)
            time.sleep(CONTROL_PERIOD)
        return goal_handle.abort, none, "the node was shut down"

    def _steer(self, journey, distance, bearing, turn, near_enough):
        """Choose the phase, count a recovery where the robot has lost its way, and return the velocity."""
        if distance < NEAR:
            journey.phase = WALKING if distance > near_enough else ALIGNING
            forward, left = distance * math.cos(bearing), distance * math.sin(bearing)
            return twist(GAIN * forward, GAIN * left, GAIN * turn)
        if journey.phase != TURNING and abs(bearing) > OFF_THE_WAY:
            journey.recoveries += 1
            journey.phase = TURNING
        if journey.phase == TURNING and abs(bearing) > FACING:
            return twist(0.0, 0.0, 2 * GAIN * bearing)
        journey.phase = WALKING
        return twist(GAIN * distance * math.cos(bearing), 0.0, 2 * GAIN * bearing)

    def _publish_feedback(self, goal_handle, journey, distance, time_left):
        feedback = NavigateToPose.Feedback()
        feedback.status = journey.phase
        feedback.current_pose = self._pose
        feedback.navigation_time = Duration(seconds=time.monotonic() - journey.started).to_msg()
        feedback.estimated_time_remaining = Duration(seconds=time_left).to_msg()
        feedback.number_of_recoveries = journey.recoveries
        feedback.distance_remaining = distance
        feedback.progress_percentage = journey.progress
        goal_handle.publish_feedback(feedback)



def main(args=None):
    rclpy.init(args=args)
    node = NavigationServer()
    # One thread drives, one may hold a goal that waits for its turn, the others serve odom, goals and cancels.
    executor = MultiThreadedExecutor(num_threads=4)
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
