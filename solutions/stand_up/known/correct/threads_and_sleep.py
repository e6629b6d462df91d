"""Style: as in the notebook: a class, MultiThreadedExecutor and time.sleep in the execute callback."""

import math
import threading
import time
from dataclasses import dataclass

import rclpy
from geometry_msgs.msg import Twist, WrenchStamped
from humanoid_interfaces.action import StandUp
from humanoid_interfaces.msg import RobotState
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

CONTROL_PERIOD = 0.05  # s, as long as odom's
FEEDBACK_PERIOD = 0.2  # s
CLIMB = 0.15  # m/s
STANCE, RISEN = 0.60, 0.59  # m, heights of base_link
EVEN, UNEVEN = 0.8, 0.6  # smaller load over larger: good enough to rise, bad enough to shift again
STILL, UPRIGHT = 0.02, 0.05  # m/s, rad
EVEN_TIME, CALM_TIME = 0.3, 0.5  # s for which the loads must be even, and the robot calm
TIME_LIMIT = 12.0  # s

SHIFTING, RISING, SETTLING, DONE = "shifting", "rising", "settling", "done"


@dataclass
class Body:
    """What is measured of the robot at one moment."""

    height: float  # m, of base_link
    climb: float  # m/s, upwards
    speed: float  # m/s, in any direction
    tilt: float  # rad, from the vertical
    evenness: float  # the smaller of the feet's loads over the larger

    @property
    def is_calm(self):
        return self.height >= RISEN and self.speed < STILL and self.tilt < UPRIGHT


class Rise:
    """The phases of one goal, from what is measured. It knows nothing of ROS."""

    def __init__(self, height):
        self.phase = SHIFTING
        self.percent = 0.0
        self._start = height  # m
        self._since = None  # s, since when the condition that ends the phase has been true

    def advance(self, now, body):
        """Look at the body, and change the phase if the measurements say so."""
        if self.phase == SHIFTING:
            if self._lasts(body.evenness >= EVEN, now, EVEN_TIME):
                self._enter(RISING)
        elif body.evenness < UNEVEN:
            self._enter(SHIFTING)
            self.percent = 0.0  # it may fall here, and is measured anew
        elif self.phase == RISING:
            if body.height >= RISEN:
                self._enter(SETTLING)
        elif self._lasts(body.is_calm, now, CALM_TIME):
            self._enter(DONE)
        self._measure(body.height)

    def _enter(self, phase):
        self.phase, self._since = phase, None

    def _lasts(self, condition, now, duration):
        """Return whether a condition has been true for so long (s) without a break."""
        if not condition:
            self._since = None
            return False
        if self._since is None:
            self._since = now
        return now - self._since >= duration

    def _measure(self, height):
        """Raise the percentage to the share of the way that is done; 100 is kept for the end."""
        share = 100.0 * (height - self._start) / (STANCE - self._start)
        self.percent = 100.0 if self.phase == DONE else max(self.percent, min(99.0, share))


class StandUpServer(Node):
    def __init__(self):
        super().__init__("stand_up_server")
        self._odom = None  # Odometry
        self._state = None  # RobotState
        self._loads = {}  # N, by "l" and "r"
        self._busy = threading.Lock()  # held by the goal that has the robot
        self._cmd_vel = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", self._on_odom, 10)
        self.create_subscription(RobotState, "robot_state", self._on_robot_state, LATCHED)
        self.create_subscription(WrenchStamped, "l_foot/wrench", lambda message: self._on_load("l", message), 10)
        self.create_subscription(WrenchStamped, "r_foot/wrench", lambda message: self._on_load("r", message), 10)
        self._server = ActionServer(
            self,
            StandUp,
            "stand_up",
            execute_callback=self._execute,
            goal_callback=self._on_goal,
            cancel_callback=self._on_cancel,
        )

    def _on_odom(self, message):
        self._odom = message

    def _on_robot_state(self, message):
        self._state = message

    def _on_load(self, side, message):
        self._loads[side] = message.wrench.force.z

    def _body(self):
        """Return what is measured now."""
        q, velocity = self._odom.pose.pose.orientation, self._odom.twist.twist.linear
        left, right = self._loads["l"], self._loads["r"]
        return Body(
            height=self._odom.pose.pose.position.z,
            climb=velocity.z,
            speed=math.hypot(velocity.x, velocity.y, velocity.z),
            tilt=math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (q.x**2 + q.y**2)))),
            evenness=max(0.0, min(left, right)) / max(left, right, 1.0),
        )

    def _publish_climb(self, velocity):
        """Raise the pelvis (m/s); 0 holds its height."""
        twist = Twist()
        twist.linear.z = velocity
        self._cmd_vel.publish(twist)

    def _on_goal(self, request):
        """Step 1: reject what cannot even begin; the client learns no reason."""
        if self._odom is None or self._state is None or len(self._loads) < 2:
            self.get_logger().warning("goal rejected: nothing is known of the robot yet")
            return GoalResponse.REJECT
        if self._state.mode in (RobotState.FALLEN, RobotState.OFF):
            self.get_logger().warning("goal rejected: the robot cannot rise from a fall, nor without power")
            return GoalResponse.REJECT
        if not self._busy.acquire(blocking=False):
            self.get_logger().warning("goal rejected: another one has the robot")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def _execute(self, goal_handle):
        """Steps 2 to 7: rise, fill the result, make one terminal call."""
        result = StandUp.Result()
        try:
            finish, result.error_code, result.error_msg = self._rise(goal_handle)
        finally:
            self._publish_climb(0.0)
            self._busy.release()
        if rclpy.ok():
            finish()
        return result

    def _rise(self, goal_handle):
        """Bring the robot up; return the terminal call to make, the error code and a message for people."""
        none, fell = StandUp.Result.NONE, StandUp.Result.FELL
        started = feedback_due = time.monotonic()
        if self._body().height >= RISEN:
            return goal_handle.abort, StandUp.Result.ALREADY_STANDING, "the robot stands already"
        rise = Rise(self._body().height)
        while rclpy.ok():
            now, body = time.monotonic(), self._body()
            if self._state.mode in (RobotState.FALLEN, RobotState.OFF):
                return goal_handle.abort, fell, f"the robot fell while {rise.phase}"
            if goal_handle.is_cancel_requested:
                self._publish_climb(0.0)
                if abs(body.climb) < STILL:
                    return goal_handle.canceled, none, ""
            elif now - started > TIME_LIMIT:
                return goal_handle.abort, none, f"not up after {TIME_LIMIT:.0f} s, still {rise.phase}"
            else:
                rise.advance(now, body)
                self._publish_climb(CLIMB if rise.phase in (RISING, SETTLING) else 0.0)
            if now >= feedback_due or rise.phase == DONE:
                feedback_due = now + FEEDBACK_PERIOD
                self._publish_feedback(goal_handle, rise)
            if rise.phase == DONE:
                return goal_handle.succeed, none, ""
            time.sleep(CONTROL_PERIOD)
        return goal_handle.abort, none, "the node was shut down"

    def _publish_feedback(self, goal_handle, rise):
        feedback = StandUp.Feedback()
        feedback.phase = SETTLING if rise.phase == DONE else rise.phase
        feedback.percent_complete = rise.percent
        goal_handle.publish_feedback(feedback)


def main(args=None):
    rclpy.init(args=args)
    node = StandUpServer()
    # One thread raises the robot, the others serve its topics, goals and cancels.
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
