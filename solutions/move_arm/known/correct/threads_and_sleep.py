"""Style: a class, MultiThreadedExecutor and time.sleep in the execute callback; one merged trajectory for both arms."""

import math
import threading
import time
from bisect import bisect_right

import rclpy
from humanoid_interfaces.action import MoveArm
from humanoid_interfaces.msg import JointLimits
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

CONTROL_PERIOD = 0.05  # s, as long as that of joint_states
FEEDBACK_PERIOD = 0.1  # s
PATH_TOLERANCE = 0.5  # rad
GOAL_TOLERANCE = 0.05  # rad, where the goal says 0
GOAL_TIME = 1.0  # s after the last point in which the arm may still arrive
SILENCE = 1.0  # s without joint_states


def seconds_of(point):
    """Return the time_from_start (s) of a point."""
    return point.time_from_start.sec + point.time_from_start.nanosec * 1e-9


class Plan:
    """A trajectory from where the joints were when it began; straight between its points.

    Attributes:
        joints: their names.
        begin, end: s, on time.monotonic().
    """

    def __init__(self, trajectory, start):
        self.joints = list(trajectory.joint_names)
        self.begin = time.monotonic()
        self.times = [0.0, *map(seconds_of, trajectory.points)]
        self.places = [[start[joint] for joint in self.joints], *(point.positions for point in trajectory.points)]
        self.end = self.begin + self.times[-1]

    def positions_at(self, moment):
        """Return where the joints should be (rad) at a moment (s), in the order of their names."""
        after = min(bisect_right(self.times, moment - self.begin), len(self.times) - 1)
        earlier, later = self.times[after - 1], self.times[after]
        share = min(1.0, (moment - self.begin - earlier) / (later - earlier))
        return [p + share * (q - p) for p, q in zip(self.places[after - 1], self.places[after])]

    def waypoint_at(self, moment):
        """Return the index, counted from 0, of the point that the arm moves to at a moment (s)."""
        return min(bisect_right(self.times, moment - self.begin), len(self.times) - 1) - 1


class ArmServer(Node):
    def __init__(self):
        super().__init__("arm_server")
        self._limits = {}  # joint: (lower, upper), rad
        self._measured = {}  # joint: rad
        self._measured_at = 0.0  # s, when the last joint_states came
        self._newest = {}  # arm: the goal that has it
        self._plans = {}  # arm: the Plan that the robot follows
        self._lock = threading.Lock()  # two goals may execute at the same time
        self._trajectories = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self.create_subscription(JointLimits, "joint_limits", self._on_limits, LATCHED)
        self.create_subscription(JointState, "joint_states", self._on_joint_states, qos_profile_sensor_data)
        self._server = ActionServer(
            self,
            MoveArm,
            "move_arm",
            execute_callback=self._execute,
            goal_callback=self._on_goal,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
        )

    def _on_limits(self, message):
        self._limits = dict(zip(message.names, zip(message.lower, message.upper)))

    def _on_joint_states(self, message):
        self._measured = dict(zip(message.name, message.position))
        self._measured_at = time.monotonic()

    def _on_goal(self, request):
        if objection := self._objection(request):
            self.get_logger().warning(f"goal rejected: {objection}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _objection(self, request):
        """Return why a goal cannot be carried out, or nothing."""
        joints, points = request.trajectory.joint_names, request.trajectory.points
        if request.arm not in ("l", "r"):
            return f"the arms are l and r, not {request.arm!r}"
        for joint in joints:
            if joint not in self._limits or not joint.startswith(request.arm + "_"):
                return f"{joint!r} is not a joint of the arm {request.arm}"
            if joint not in self._measured:
                return f"nothing is known of {joint} yet"
        if not joints or not points:
            return "there is no joint, or no point"
        earlier = 0.0
        for number, point in enumerate(points):
            if len(point.positions) != len(joints):
                return f"point {number} has {len(point.positions)} positions for {len(joints)} joints"
            if seconds_of(point) <= earlier:
                return f"point {number} is not later than the one before"
            earlier = seconds_of(point)
            for joint, position in zip(joints, point.positions):
                lower, upper = self._limits[joint]
                if not math.isfinite(position) or not lower <= position <= upper:
                    return f"{joint} cannot get to {position} rad (point {number})"
        return ""

    def _on_accepted(self, goal_handle):
        self._newest[goal_handle.request.arm] = goal_handle
        goal_handle.execute()

    def _begin(self, goal_handle):
        """Have the robot follow the goal's trajectory; return its Plan."""
        arm = goal_handle.request.arm
        with self._lock:
            plan = Plan(goal_handle.request.trajectory, self._measured)
            if self._newest[arm] is goal_handle:
                self._plans[arm] = plan
                self._publish_plans()
        return plan

    def _end(self, arm, plan, hold):
        """Forget a plan, unless a later one has taken its place; `hold`: its arm stops at once."""
        with self._lock:
            if self._plans.get(arm) is plan:
                del self._plans[arm]
                if hold:
                    self._publish_plans()

    def _publish_plans(self):
        """Publish one trajectory with what is left of every plan; without a plan it is empty: hold."""
        now = time.monotonic()
        plans = list(self._plans.values())
        moments = {round(plan.begin + t, 3) for plan in plans for t in plan.times}
        message = JointTrajectory(joint_names=[joint for plan in plans for joint in plan.joints])
        for moment in sorted(moment for moment in moments if moment > now):
            positions = [position for plan in plans for position in plan.positions_at(moment)]
            after = Duration(seconds=moment - now).to_msg()
            message.points.append(JointTrajectoryPoint(positions=positions, time_from_start=after))
        self._trajectories.publish(message)

    def _publish_feedback(self, goal_handle, plan, now, max_error):
        feedback = MoveArm.Feedback()
        feedback.waypoint = plan.waypoint_at(now)
        feedback.max_error = max_error
        feedback.progress_percentage = min(100.0, 100.0 * (now - plan.begin) / (plan.end - plan.begin))
        goal_handle.publish_feedback(feedback)

    def _execute(self, goal_handle):
        """Watch the arm until it has arrived, or cannot; make one terminal call, return the result."""
        arm = goal_handle.request.arm
        tolerance = goal_handle.request.goal_tolerance or GOAL_TOLERANCE
        plan = self._begin(goal_handle)
        result = MoveArm.Result()
        feedback_due = plan.begin
        while rclpy.ok():
            now = time.monotonic()
            wanted = zip(plan.joints, plan.positions_at(now))
            errors = {joint: abs(self._measured[joint] - position) for joint, position in wanted}
            worst = max(errors, key=errors.get)

            if goal_handle.is_cancel_requested:
                self._end(arm, plan, hold=True)
                goal_handle.canceled()
                return result

            if self._newest[arm] is not goal_handle:
                result.error_code, result.error_msg = MoveArm.Result.PREEMPTED, "a later goal took the arm"
            elif now - self._measured_at > SILENCE:
                result.error_code = MoveArm.Result.INVALID_JOINTS
                result.error_msg = f"joint_states have said nothing of {worst} for {SILENCE} s"
            elif errors[worst] > PATH_TOLERANCE:
                result.error_code = MoveArm.Result.PATH_TOLERANCE_VIOLATED
                result.error_msg = f"{worst} is {errors[worst]:.2f} rad off its trajectory"
            elif now > plan.end + GOAL_TIME and errors[worst] > tolerance:
                result.error_code = MoveArm.Result.GOAL_TOLERANCE_VIOLATED
                result.error_msg = f"{worst} is {errors[worst]:.2f} rad from its end"
            if result.error_code != MoveArm.Result.NONE:
                self._end(arm, plan, hold=True)
                goal_handle.abort()
                return result

            if now >= plan.end and errors[worst] <= tolerance:
                self._end(arm, plan, hold=False)
                goal_handle.succeed()
                return result

            if now >= feedback_due:
                feedback_due += FEEDBACK_PERIOD
                self._publish_feedback(goal_handle, plan, now, errors[worst])
            time.sleep(CONTROL_PERIOD)
        return result


def main(args=None):
    rclpy.init(args=args)
    node = ArmServer()
    # Each goal under way keeps a thread; by default there are as many threads as processors, which may be two.
    executor = MultiThreadedExecutor(num_threads=6)
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
