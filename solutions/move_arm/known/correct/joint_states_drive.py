"""Style: each joint_states message advances all motions, a timer watches for silence, and execute awaits a Future.
The newest goal aborts the older one on its acceptance; canceled() comes only when the arm stands.
"""

import math
import time

import rclpy
from humanoid_interfaces.action import MoveArm
from humanoid_interfaces.msg import JointLimits
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.task import Future
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

Result = MoveArm.Result
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
STANDING = 0.04  # rad/s


class Motion:
    """One goal on its way."""

    def __init__(self, goal_handle, angles):
        request = goal_handle.request
        self.goal_handle = goal_handle
        self.arm = request.arm
        self.tolerance = request.goal_tolerance if request.goal_tolerance else 0.05
        self.names = list(request.trajectory.joint_names)
        self.knots = [(0.0, [angles[name] for name in self.names])]
        for point in request.trajectory.points:
            after = point.time_from_start
            self.knots.append((after.sec + after.nanosec / 1e9, list(point.positions)))
        self.begin = time.monotonic()
        self.duration = self.knots[-1][0]
        self.next_feedback = 0.0
        self.stopping = False
        self.over = Future()

    def segment(self, elapsed):
        for index, (moment, _) in enumerate(self.knots[1:]):
            if elapsed < moment:
                return index
        return len(self.knots) - 2

    def wanted(self, elapsed):
        index = self.segment(elapsed)
        (t0, before), (t1, after) = self.knots[index], self.knots[index + 1]
        share = min(1.0, (elapsed - t0) / (t1 - t0))
        return [(1 - share) * p + share * q for p, q in zip(before, after)]


class ArmServer(Node):
    def __init__(self):
        super().__init__("arm_server")
        self.limits = None
        self.angles = None
        self.heard = time.monotonic()
        self.motions = {}  # arm: Motion under way
        self.accepted = {}  # goal id: Motion
        self.robot = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self.create_subscription(JointLimits, "joint_limits", self.on_limits, LATCHED)
        self.create_subscription(JointState, "joint_states", self.on_joint_states, qos_profile_sensor_data)
        self.create_timer(0.1, self.watch)
        self.server = ActionServer(
            self,
            MoveArm,
            "move_arm",
            execute_callback=self.execute,
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=self.on_cancel,
        )

    def on_limits(self, message):
        self.limits = {name: (a, b) for name, a, b in zip(message.names, message.lower, message.upper)}

    def on_goal(self, request):
        try:
            self.examine(request)
        except ValueError as objection:
            self.get_logger().warning(f"rejected: {objection}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def examine(self, request):
        if self.limits is None or self.angles is None:
            raise ValueError("limits or joints are not known yet")
        if request.arm not in {"l", "r"}:
            raise ValueError(f"no arm {request.arm!r}")
        names = request.trajectory.joint_names
        mine = {name for name in self.limits if name.startswith(f"{request.arm}_")}
        if not names or set(names) - mine or len(set(names)) < len(names):
            raise ValueError(f"joints {list(names)}; the arm has {sorted(mine)}")
        if not request.trajectory.points:
            raise ValueError("no point")
        before = -1
        for point in request.trajectory.points:
            after = point.time_from_start.sec * 10**9 + point.time_from_start.nanosec
            if after <= max(before, 0):
                raise ValueError("the times do not rise")
            before = after
            if len(point.positions) != len(names):
                raise ValueError("one position for each joint, please")
            for name, position in zip(names, point.positions):
                if math.isnan(position) or position < self.limits[name][0] or position > self.limits[name][1]:
                    raise ValueError(f"{name} cannot be at {position}")

    def on_accepted(self, goal_handle):
        motion = Motion(goal_handle, self.angles)
        if old := self.motions.get(motion.arm):
            self.end(old, old.goal_handle.abort, Result.PREEMPTED, "a new goal has this arm", tell=False)
        self.motions[motion.arm] = self.accepted[bytes(goal_handle.goal_id.uuid)] = motion
        self.tell_robot()
        goal_handle.execute()

    async def execute(self, goal_handle):
        return await self.accepted.pop(bytes(goal_handle.goal_id.uuid)).over

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def tell_robot(self):
        now = time.monotonic()
        motions = [motion for motion in self.motions.values() if not motion.stopping]
        due = {motion.begin + t for motion in motions for t, _ in motion.knots[1:]}
        message = JointTrajectory(joint_names=[name for motion in motions for name in motion.names])
        last = now
        for moment in sorted(due):
            if moment < last + 0.002:
                continue
            last = moment
            point = JointTrajectoryPoint()
            point.positions = [angle for motion in motions for angle in motion.wanted(moment - motion.begin)]
            nanoseconds = round((moment - now) * 1e9)
            point.time_from_start.sec, point.time_from_start.nanosec = divmod(nanoseconds, 10**9)
            message.points.append(point)
        self.robot.publish(message)

    def end(self, motion, terminal_call, code=Result.NONE, why="", tell=True):
        if self.motions.get(motion.arm) is motion:
            del self.motions[motion.arm]
        if tell:
            self.tell_robot()
        terminal_call()
        motion.over.set_result(Result(error_code=code, error_msg=why))

    def watch(self):
        if time.monotonic() - self.heard > 1.0:
            for motion in list(self.motions.values()):
                self.end(motion, motion.goal_handle.abort, Result.INVALID_JOINTS, "joint_states are silent")

    def on_joint_states(self, message):
        self.angles = dict(zip(message.name, message.position))
        self.heard = time.monotonic()
        rates = dict(zip(message.name, message.velocity))
        for motion in list(self.motions.values()):
            self.advance(motion, self.heard - motion.begin, rates)

    def advance(self, motion, elapsed, rates):
        if motion.stopping:
            if all(abs(rates[name]) < STANDING for name in motion.names):
                self.end(motion, motion.goal_handle.canceled, tell=False)
            return
        if motion.goal_handle.is_cancel_requested:
            motion.stopping = True
            self.tell_robot()
            return
        errors = [abs(self.angles[name] - angle) for name, angle in zip(motion.names, motion.wanted(elapsed))]
        error = max(errors)
        worst = motion.names[errors.index(error)]
        abort = motion.goal_handle.abort
        if error > 0.5:
            self.end(motion, abort, Result.PATH_TOLERANCE_VIOLATED, f"{worst}: {error:.2f} rad off its way")
        elif elapsed >= motion.duration and error <= motion.tolerance:
            self.end(motion, motion.goal_handle.succeed, tell=False)
        elif elapsed > motion.duration + 1.0:
            self.end(motion, abort, Result.GOAL_TOLERANCE_VIOLATED, f"{worst}: {error:.2f} rad short")
        elif elapsed >= motion.next_feedback:
            motion.next_feedback += 0.1
            feedback = MoveArm.Feedback(waypoint=motion.segment(elapsed), max_error=error)
            feedback.progress_percentage = min(100.0, 100.0 * elapsed / motion.duration)
            motion.goal_handle.publish_feedback(feedback)


def main(args=None):
    rclpy.init(args=args)
    node = ArmServer()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
