"""The three processes of a run: a walking action server, the robot's traffic, and a client that measures.

    python -m ros_runtime.executor_bench.nodes server|traffic|client [cancel]

The client says "ready" when all are connected, waits for a line on stdin, sends one goal and prints what it
measured as JSON. All times are on the clock the three share.
"""

from __future__ import annotations

import json
import queue
import sys
import threading
import time
from itertools import pairwise
from typing import Any

import rclpy
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Imu, JointState

from humanoid_interfaces.action import WalkTo

WORKERS = 2  # what a machine with two cores gets by default
WALK_S = 4.0
CANCEL_AFTER_S = 2.0
CONTROL_PERIOD_S = 0.05
FEEDBACK_PERIOD_S = 0.2
SENSOR_PERIOD_S = 0.2
SENSOR_READ_S = 0.1
ANSWER_TIMEOUT_S = 20.0
SETTLE_S = 0.2


class Walker(Node):
    """A sound server as students write it: a sleeping execute loop that odometry and cancels overtake.

    A slow sensor fills the second worker for a part of the time, as any second blocking callback would;
    with all workers of the pool asleep the fault shows most clearly.
    """

    def __init__(self) -> None:
        super().__init__("walker")
        group = ReentrantCallbackGroup()
        self._odometry: Odometry | None = None
        self._joint_state: JointState | None = None
        self.create_subscription(Odometry, "odom", self._on_odometry, 10)
        self.create_subscription(JointState, "joint_states", self._on_joint_state, qos_profile_sensor_data)
        self.create_timer(SENSOR_PERIOD_S, self._read_slow_sensor, MutuallyExclusiveCallbackGroup())
        self._velocity = self.create_publisher(Twist, "cmd_vel", 10)
        self._server = ActionServer(
            self,
            WalkTo,
            "walk_to",
            execute_callback=self._walk,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
            callback_group=group,
        )

    def _on_odometry(self, message: Odometry) -> None:
        self._odometry = message

    def _on_joint_state(self, message: JointState) -> None:
        self._joint_state = message

    def _read_slow_sensor(self) -> None:
        time.sleep(SENSOR_READ_S)

    def _walk(self, goal_handle: Any) -> WalkTo.Result:
        feedback = WalkTo.Feedback()
        start = time.monotonic()
        next_feedback = start
        while time.monotonic() < start + WALK_S and not goal_handle.is_cancel_requested:
            self._velocity.publish(Twist())
            if time.monotonic() >= next_feedback:
                next_feedback += FEEDBACK_PERIOD_S
                feedback.distance_remaining = start + WALK_S - time.monotonic()
                goal_handle.publish_feedback(feedback)
            time.sleep(CONTROL_PERIOD_S)
        # The message has no field for it, and the client wants to know how long the answer was under way.
        result = WalkTo.Result(error_msg=str(time.monotonic()))
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
        else:
            goal_handle.succeed()
        return result


class Traffic(Node):
    """What the robot publishes all the time, at the rates a busy one does."""

    def __init__(self) -> None:
        super().__init__("traffic")
        self._outputs = [
            (self.create_publisher(Odometry, "odom", 10), Odometry(), 50.0),
            (self.create_publisher(Imu, "imu", qos_profile_sensor_data), Imu(), 50.0),
            (
                self.create_publisher(JointState, "joint_states", qos_profile_sensor_data),
                _joint_state(),
                20.0,
            ),
        ]
        for publisher, message, rate in self._outputs:
            self.create_timer(1.0 / rate, lambda p=publisher, m=message: p.publish(m))


def _joint_state() -> JointState:
    values = [0.0] * 30
    names = [f"joint_{i}" for i in range(30)]
    return JointState(name=names, position=values, velocity=values, effort=values)


def _measure(cancel: bool) -> None:
    """Send one goal, print the measurements."""
    node = Node("client")
    client = ActionClient(node, WalkTo, "walk_to")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    spinner = threading.Thread(target=executor.spin)
    spinner.start()
    try:
        print(json.dumps(_one_goal(node, client, cancel)), flush=True)
    finally:
        executor.shutdown()
        spinner.join()


def _one_goal(node: Node, client: ActionClient, cancel: bool) -> dict[str, Any]:
    while not (
        client.server_is_ready() and node.count_publishers("odom") and node.count_publishers("cmd_vel")
    ):
        time.sleep(0.02)
    # The client knows its servers now; that the server knows the client too cannot be asked, only waited for.
    time.sleep(SETTLE_S)
    print("ready", flush=True)
    sys.stdin.readline()

    arrivals: list[float] = []
    sent = time.monotonic()
    goal_handle, accepted = _answer(
        client.send_goal_async(WalkTo.Goal(), feedback_callback=lambda _: arrivals.append(time.monotonic()))
    )
    outcome = goal_handle.get_result_async()
    cancelled = None
    if cancel:
        time.sleep(CANCEL_AFTER_S)
        cancelled = time.monotonic()
        goal_handle.cancel_goal_async()
    wrapped, received = _answer(outcome)
    gaps = [later - earlier for earlier, later in pairwise(arrivals)]
    right_status = GoalStatus.STATUS_CANCELED if cancel else GoalStatus.STATUS_SUCCEEDED
    return {
        "accept_s": accepted - sent,
        "duration_s": received - accepted,
        "feedback_hz": len(gaps) / sum(gaps) if gaps else 0.0,
        "max_gap_s": max(gaps, default=0.0),
        "result_s": received - float(wrapped.result.error_msg),
        "cancel_s": received - cancelled if cancelled else None,
        "right_status": wrapped.status == right_status,
    }


def _answer(future: Any) -> tuple[Any, float]:
    """Wait for a future that another thread spins; returns its result and the time it came."""
    arrived: queue.SimpleQueue[float] = queue.SimpleQueue()
    future.add_done_callback(lambda _: arrived.put(time.monotonic()))
    try:
        when = arrived.get(timeout=ANSWER_TIMEOUT_S)
    except queue.Empty:
        raise TimeoutError(f"no answer within {ANSWER_TIMEOUT_S} s") from None
    return future.result(), when


def main() -> None:
    role, *options = sys.argv[1:]
    rclpy.init()
    try:
        if role == "client":
            _measure(cancel="cancel" in options)
            return
        executor = MultiThreadedExecutor(WORKERS) if role == "server" else SingleThreadedExecutor()
        executor.add_node(Walker() if role == "server" else Traffic())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
