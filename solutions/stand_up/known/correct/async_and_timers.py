"""Style: one thread; an async execute callback that awaits one-shot timers; conditions over windows of samples."""

import math
from collections import deque

import rclpy
from geometry_msgs.msg import Twist, WrenchStamped
from humanoid_interfaces.action import StandUp
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future

PERIOD = 0.05  # s
EVEN_ROUNDS, CALM_ROUNDS = 8, 12  # a little more than 0.3 s and 0.5 s


class Riser(Node):
    def __init__(self):
        super().__init__("riser")
        self.odom = None
        self.state = None
        self.loads = [None, None]
        self.active = False
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 1)
        self.create_subscription(Odometry, "odom", self.on_odom, 1)
        self.create_subscription(RobotState, "robot_state", self.on_state, 1)
        self.create_subscription(WrenchStamped, "l_foot/wrench", self.on_left, 1)
        self.create_subscription(WrenchStamped, "r_foot/wrench", self.on_right, 1)
        self.server = ActionServer(
            self,
            StandUp,
            "stand_up",
            self.execute,
            goal_callback=self.on_goal,
            cancel_callback=self.on_cancel,
        )

    def on_odom(self, odom):
        self.odom = odom

    def on_state(self, state):
        self.state = state

    def on_left(self, wrench):
        self.loads[0] = wrench.wrench.force.z

    def on_right(self, wrench):
        self.loads[1] = wrench.wrench.force.z

    def on_goal(self, request):
        if self.active or self.odom is None or self.state is None or None in self.loads:
            return GoalResponse.REJECT
        self.active = True
        return GoalResponse.ACCEPT

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def climb(self, rate):
        twist = Twist()
        twist.linear.z = rate
        self.cmd_vel.publish(twist)

    async def sleep(self, seconds):
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        try:
            await done
        finally:
            self.destroy_timer(timer)

    async def execute(self, goal_handle):
        try:
            return await self.rise(goal_handle)
        finally:
            self.active = False

    async def rise(self, goal_handle):
        clock = self.get_clock()
        begin = clock.now()
        start = self.odom.pose.pose.position.z
        even, calm = deque(maxlen=EVEN_ROUNDS), deque(maxlen=CALM_ROUNDS)
        phase, percent, rounds = "shifting", 0.0, 0
        result = StandUp.Result()

        def abort(code, message):
            self.climb(0.0)
            result.error_code, result.error_msg = code, message
            goal_handle.abort()
            return result

        if self.state.mode == RobotState.FALLEN:
            return abort(StandUp.Result.FELL, "it lies on the floor")
        if start >= 0.59:
            return abort(StandUp.Result.ALREADY_STANDING, "it stands")
        while True:
            if self.state.mode in (RobotState.FALLEN, RobotState.OFF):
                return abort(StandUp.Result.FELL, "it fell")
            if goal_handle.is_cancel_requested:
                self.climb(0.0)
                goal_handle.canceled()
                return result
            if (clock.now() - begin).nanoseconds > 12e9:
                return abort(StandUp.Result.NONE, f"{phase} for too long")

            z, q = self.odom.pose.pose.position.z, self.odom.pose.pose.orientation
            v = self.odom.twist.twist.linear
            share = min(self.loads) / max(1.0, max(self.loads))
            even.append(share > 0.8)
            still = math.hypot(v.x, v.y, v.z) < 0.02
            calm.append(z >= 0.59 and still and 2 * math.hypot(q.x, q.y) < 0.05)
            if phase == "shifting":
                if len(even) == EVEN_ROUNDS and all(even):
                    phase = "rising"
            elif share < 0.7:
                phase = "shifting"
                even.clear()
                percent = 100 * (z - start) / (0.6 - start)
            elif phase == "rising" and z >= 0.59:
                phase = "settling"
                calm.clear()
            is_up = phase == "settling" and len(calm) == CALM_ROUNDS and all(calm)

            self.climb(0.0 if phase == "shifting" or is_up else 0.1)
            measured = 100 * (z - start) / (0.6 - start)
            percent = 100.0 if is_up else min(max(percent, measured, 0.0), 98.0)
            if is_up or rounds % 4 == 0:
                goal_handle.publish_feedback(StandUp.Feedback(phase=phase, percent_complete=percent))
            if is_up:
                goal_handle.succeed()
                return result
            rounds += 1
            await self.sleep(PERIOD)


def main(args=None):
    rclpy.init(args=args)
    node = Riser()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
