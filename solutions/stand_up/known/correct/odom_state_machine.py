"""Style: one thread and a state machine of methods: odom's callback moves it on, execute awaits the end."""

import math
import time

import rclpy
from geometry_msgs.msg import Twist, WrenchStamped
from humanoid_interfaces.action import StandUp
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

TOP, ENOUGH = 0.60, 0.59


class Lift(Node):
    def __init__(self):
        super().__init__("lift")
        self.left = self.right = self.state = self.odom = None
        self.goal = None  # the handle of the goal that runs
        self.reserved = False  # for a goal that is accepted and does not yet run
        self.create_subscription(WrenchStamped, "l_foot/wrench", lambda m: setattr(self, "left", m.wrench.force.z), 5)
        self.create_subscription(WrenchStamped, "r_foot/wrench", lambda m: setattr(self, "right", m.wrench.force.z), 5)
        self.create_subscription(RobotState, "robot_state", lambda m: setattr(self, "state", m), 5)
        self.create_subscription(Odometry, "odom", self.on_odom, 5)
        self.velocity = self.create_publisher(Twist, "cmd_vel", 5)
        self.server = ActionServer(
            self,
            StandUp,
            "stand_up",
            execute_callback=self.execute,
            goal_callback=self.judge,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )

    # -- goals

    def judge(self, request):
        known = None not in (self.left, self.right, self.state, self.odom)
        if not known or self.reserved or self.state.mode == RobotState.FALLEN:
            return GoalResponse.REJECT
        self.reserved = True
        return GoalResponse.ACCEPT

    async def execute(self, handle):
        self.end = Future()
        self.bottom = self.odom.pose.pose.position.z
        self.accepted = self.told = time.monotonic()
        self.progress = 0.0
        self.next = self.shift
        self.since = None
        self.goal = handle
        if self.bottom >= ENOUGH:
            self.finish("abort", StandUp.Result.ALREADY_STANDING, "I am standing already")
        verb, result = await self.end
        self.reserved = False
        getattr(handle, verb)()
        return result

    def finish(self, verb, code=StandUp.Result.NONE, message=""):
        self.goal = None
        self.lift(0.0)
        self.end.set_result((verb, StandUp.Result(error_code=code, error_msg=message)))

    # -- the robot

    def lift(self, rate):
        twist = Twist()
        twist.linear.z = rate
        self.velocity.publish(twist)

    def on_odom(self, odom):
        self.odom = odom
        if self.goal is None:
            return
        now, z = time.monotonic(), odom.pose.pose.position.z
        q, v = odom.pose.pose.orientation, odom.twist.twist.linear
        tilt = math.acos(min(1.0, 1 - 2 * (q.x * q.x + q.y * q.y)))
        if self.state.mode == RobotState.FALLEN or z < 0.38 or tilt > 0.9:
            return self.finish("abort", StandUp.Result.FELL, f"fell at {z:.2f} m")
        if self.goal.is_cancel_requested:
            return self.finish("canceled")
        if now > self.accepted + 12.0:
            return self.finish("abort", StandUp.Result.NONE, "this takes too long")

        mean = (self.left + self.right) / 2
        apart = abs(self.left - self.right) / max(mean, 1.0)
        calm = z >= ENOUGH and tilt < 0.05 and math.sqrt(v.x**2 + v.y**2 + v.z**2) < 0.02
        before = self.next
        self.next = before(now, apart, z, calm)
        if self.next != before:
            self.since = None
        share = (z - self.bottom) / (TOP - self.bottom)
        least = share if self.next == self.shift and before != self.shift else self.progress
        self.progress = max(least, min(0.99, share), 0.0)
        if self.next is None:
            self.tell("settling", 100.0)
            return self.finish("succeed")
        self.lift(0.0 if self.next == self.shift else 0.14)
        if now - self.told > 0.17:
            self.told = now
            name = {self.shift: "shifting", self.rise: "rising", self.settle: "settling"}[self.next]
            self.tell(name, 100.0 * self.progress)

    def lasts(self, condition, now, duration):
        self.since = (self.since or now) if condition else None
        return condition and now - self.since >= duration

    def shift(self, now, apart, z, calm):
        return self.rise if self.lasts(apart < 0.2, now, 0.3) else self.shift

    def rise(self, now, apart, z, calm):
        if apart > 0.5:
            return self.shift
        return self.settle if z >= ENOUGH else self.rise

    def settle(self, now, apart, z, calm):
        if apart > 0.5:
            return self.shift
        return None if self.lasts(calm, now, 0.5) else self.settle

    def tell(self, phase, percent):
        self.goal.publish_feedback(StandUp.Feedback(phase=phase, percent_complete=percent))


def main(args=None):
    rclpy.init(args=args)
    executor = SingleThreadedExecutor()
    node = Lift()
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
