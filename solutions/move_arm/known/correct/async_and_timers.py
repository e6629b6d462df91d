"""Style: one thread; an async execute callback that awaits a Future set by a one-shot timer; no lock."""

import math

import rclpy
from humanoid_interfaces.action import MoveArm
from humanoid_interfaces.msg import JointLimits
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.task import Future
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint


def time_of(point):
    return Duration.from_msg(point.time_from_start).nanoseconds * 1e-9


def is_sound(request, limits):
    names, points = request.trajectory.joint_names, request.trajectory.points
    if request.arm not in ("l", "r") or not names or not points:
        return False
    if any(name not in limits or name[:2] != request.arm + "_" for name in names):
        return False
    if any(len(point.positions) != len(names) for point in points):
        return False
    times = [0.0] + [time_of(point) for point in points]
    if any(later <= earlier for earlier, later in zip(times, times[1:])):
        return False
    for point in points:
        for name, position in zip(names, point.positions):
            low, high = limits[name]
            if not (math.isfinite(position) and low <= position <= high):
                return False
    return True


class ArmServer(Node):
    def __init__(self):
        super().__init__("arm_server")
        self.limits = {}
        self.angles = {}
        self.heard = 0.0
        self.latest = {}  # arm: goal handle
        self.tracks = {}  # arm: list of (s, {joint: rad}), the start first
        self.command = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(JointLimits, "joint_limits", self.on_limits, latched)
        self.create_subscription(JointState, "joint_states", self.on_states, qos_profile_sensor_data)
        self.server = ActionServer(
            self,
            MoveArm,
            "move_arm",
            self.execute,
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=self.on_cancel,
        )

    def now(self):
        return self.get_clock().now().nanoseconds * 1e-9

    def on_limits(self, limits):
        self.limits = {name: (low, high) for name, low, high in zip(limits.names, limits.lower, limits.upper)}

    def on_states(self, states):
        self.angles.update(zip(states.name, states.position))
        self.heard = self.now()

    def on_goal(self, request):
        if self.angles and is_sound(request, self.limits):
            return GoalResponse.ACCEPT
        return GoalResponse.REJECT

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def on_accepted(self, goal_handle):
        self.latest[goal_handle.request.arm] = goal_handle
        goal_handle.execute()

    async def sleep(self, seconds):
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        try:
            await done
        finally:
            self.destroy_timer(timer)

    def track_of(self, trajectory):
        begin = self.now()
        track = [(begin, {name: self.angles[name] for name in trajectory.joint_names})]
        for point in trajectory.points:
            track.append((begin + time_of(point), dict(zip(trajectory.joint_names, point.positions))))
        return track

    @staticmethod
    def place(track, moment):
        """Return where a track has its joints (rad) at a moment (s)."""
        for (t0, before), (t1, after) in zip(track, track[1:]):
            if moment < t1:
                share = max(0.0, (moment - t0) / (t1 - t0))
                return {name: before[name] + share * (after[name] - before[name]) for name in before}
        return track[-1][1]

    def send(self):
        """Send the robot what is left of all tracks; nothing means hold."""
        now = self.now()
        moments = sorted({t for track in self.tracks.values() for t, _ in track if t > now + 0.001})
        message = JointTrajectory()
        for moment in moments:
            places = {}
            for track in self.tracks.values():
                places |= self.place(track, moment)
            message.joint_names = list(places)
            point = JointTrajectoryPoint(positions=list(places.values()))
            point.time_from_start = Duration(seconds=moment - now).to_msg()
            message.points.append(point)
        self.command.publish(message)

    def drop(self, arm, track):
        if self.tracks.get(arm) is track:
            del self.tracks[arm]
            self.send()

    async def execute(self, goal_handle):
        request = goal_handle.request
        arm, tolerance = request.arm, request.goal_tolerance or 0.05
        track = self.track_of(request.trajectory)
        if self.latest[arm] is goal_handle:
            self.tracks[arm] = track
            self.send()
        begin, end = track[0][0], track[-1][0]
        rounds = 0
        while True:
            now = self.now()
            errors = {name: abs(self.angles[name] - angle) for name, angle in self.place(track, now).items()}
            error, worst = max((error, name) for name, error in errors.items())

            if goal_handle.is_cancel_requested:
                self.drop(arm, track)
                goal_handle.canceled()
                return MoveArm.Result()
            reason = None
            if self.latest[arm] is not goal_handle:
                reason = MoveArm.Result.PREEMPTED, "another goal came"
            elif now - self.heard > 1.0:
                reason = MoveArm.Result.INVALID_JOINTS, "no joint_states"
            elif error > 0.5:
                reason = MoveArm.Result.PATH_TOLERANCE_VIOLATED, f"{worst} does not follow"
            elif now > end + 1.0 and error > tolerance:
                reason = MoveArm.Result.GOAL_TOLERANCE_VIOLATED, f"{worst} did not arrive"
            if reason:
                self.drop(arm, track)
                goal_handle.abort()
                return MoveArm.Result(error_code=reason[0], error_msg=reason[1])
            if now >= end and error <= tolerance:
                self.tracks.pop(arm)
                goal_handle.succeed()
                return MoveArm.Result()

            if rounds % 2 == 0:
                goal_handle.publish_feedback(
                    MoveArm.Feedback(
                        waypoint=min(sum(now >= t for t, _ in track[1:]), len(track) - 2),
                        max_error=error,
                        progress_percentage=100.0 * min(1.0, (now - begin) / (end - begin)),
                    )
                )
            rounds += 1
            await self.sleep(0.05)


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
