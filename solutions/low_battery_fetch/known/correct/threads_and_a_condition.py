"""Style: MultiThreadedExecutor; execute blocks on a Condition that every message and every answer notifies."""

import math
import threading
import time
from contextlib import suppress

import rclpy
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from humanoid_interfaces.action import NavigateToPose, PickAndPlace
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Header

LIMIT = 5.0
HOLDING = {"lifting", "moving", "placing", "retreating"}


def stamped(x, y, z=0.0):
    pose = Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(w=1.0))
    return PoseStamped(header=Header(frame_id="odom"), pose=pose)


class Ending(Exception):
    def __init__(self, how, message="", code=0):
        super().__init__(message)
        self.how, self.message, self.code = how, message, code


class FetchServer(Node):
    def __init__(self):
        super().__init__("fetch_server")
        self.changed = threading.Condition()
        self.one_at_a_time = threading.Lock()
        self.percentage = math.nan
        self.low = False  # at any moment of this fetch
        self.newest = None
        answers = ReentrantCallbackGroup()
        self.walker = ActionClient(self, NavigateToPose, "navigate_to_pose", callback_group=answers)
        self.arm = ActionClient(self, PickAndPlace, "pick_and_place", callback_group=answers)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        own = MutuallyExclusiveCallbackGroup()
        self.create_subscription(BatteryState, "battery_state", self.on_battery, latched, callback_group=own)
        self.server = ActionServer(
            self,
            PickAndPlace,
            "fetch",
            self.execute,
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=self.on_cancel,
            callback_group=ReentrantCallbackGroup(),
        )

    # -- everything that happens wakes up execute

    def tell(self, *_):
        with self.changed:
            self.changed.notify_all()

    def on_battery(self, state):
        if 0.0 <= state.percentage <= 1.0:
            self.percentage = state.percentage
            self.low = self.low or state.percentage < 0.2
            self.tell()

    def on_goal(self, request):
        p, q = request.place_pose.pose.position, request.place_pose.pose.orientation
        if request.place_pose.header.frame_id != "odom":
            return GoalResponse.REJECT
        if not all(math.isfinite(n) for n in (p.x, p.y, p.z, q.x, q.y, q.z, q.w)):
            return GoalResponse.REJECT
        if not (math.isfinite(request.grasp_force) and request.grasp_force > 0):
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def on_accepted(self, goal_handle):
        self.newest = goal_handle
        self.tell()
        goal_handle.execute()

    def on_cancel(self, goal_handle):
        self.tell()
        return CancelResponse.ACCEPT

    def until(self, condition, seconds):
        """Wait at most so long; also look by itself, since a cancel is told before rclpy knows of it."""
        end = time.monotonic() + seconds
        with self.changed:
            while not condition():
                left = end - time.monotonic()
                if left <= 0:
                    return False
                self.changed.wait(min(left, 0.1))
        return True

    # -- a fetch

    def execute(self, goal_handle):
        result = PickAndPlace.Result()
        with self.one_at_a_time:
            try:
                self.fetch(goal_handle, result)
                goal_handle.succeed()
            except Ending as ending:
                result.error_msg, result.error_code = ending.message, ending.code
                getattr(goal_handle, ending.how)()
        return result

    def fetch(self, goal_handle, result):
        request = goal_handle.request
        self.low = not self.percentage >= 0.2
        if self.low:
            raise Ending("abort", f"battery_state says {self.percentage:.2f}: too little for a fetch")
        onto_tray = PickAndPlace.Goal(object_id=request.object_id, grasp_force=request.grasp_force)
        onto_tray.place_pose = stamped(1.45, 0.0, 0.72)
        put_down = PickAndPlace.Goal(object_id=request.object_id, grasp_force=request.grasp_force)
        put_down.place_pose = request.place_pose
        self.walk(goal_handle, stamped(1.2, 0.0), lambda: self.low)
        if not self.low:
            self.grasp(goal_handle, onto_tray, result)
        self.walk(goal_handle, stamped(0.0, 0.0), lambda: False)
        if self.low:
            raise Ending("abort", f"gave up: the battery fell to {self.percentage:.2f}")
        if not self.grasp(goal_handle, put_down, result):
            raise Ending("abort", f"gave up: the battery fell to {self.percentage:.2f}, the object is on the tray")

    def walk(self, goal_handle, pose, gives_up):
        return self.delegate(
            goal_handle, self.walker, NavigateToPose.Goal(pose=pose), gives_up, lambda _feedback: None
        )

    def grasp(self, goal_handle, goal, result):
        stage = [""]

        def on_feedback(feedback):
            stage[0] = feedback.stage
            goal_handle.publish_feedback(feedback)

        def gives_up():
            return self.low and stage[0] not in HOLDING

        answer = self.delegate(goal_handle, self.arm, goal, gives_up, on_feedback)
        if answer:
            result.final_object_pose = answer.final_object_pose
            result.max_grasp_force = max(result.max_grasp_force, answer.max_grasp_force)
        return answer

    def delegate(self, goal_handle, client, goal, gives_up, on_feedback):
        """Return the child's result, None if it was canceled for the battery."""
        name = "navigate_to_pose" if client is self.walker else "pick_and_place"
        heard = [time.monotonic()]

        def hear(message):
            heard[0] = time.monotonic()
            on_feedback(message.feedback)

        def stopped():
            return goal_handle.is_cancel_requested or goal_handle is not self.newest

        def leave():
            if goal_handle.is_cancel_requested:
                raise Ending("canceled")
            if goal_handle is not self.newest:
                raise Ending("abort", "preempted by a newer goal", PickAndPlace.Result.PREEMPTED)

        leave()
        if not self.until(client.server_is_ready, LIMIT):
            raise Ending("abort", f"the server of {name} is missing")
        leave()
        future = client.send_goal_async(goal, feedback_callback=hear)
        future.add_done_callback(self.tell)
        if not self.until(future.done, LIMIT):
            future.add_done_callback(self.send_back)
            raise Ending("abort", f"no answer from {name}")
        child = future.result()
        if not child.accepted:
            raise Ending("abort", f"{name}: rejected")
        heard[0] = time.monotonic()
        over = child.get_result_async()
        over.add_done_callback(self.tell)

        def silent():
            return time.monotonic() - heard[0] > LIMIT

        self.until(lambda: over.done() or silent() or stopped() or gives_up(), math.inf)
        called_back = not over.done()
        if called_back:
            was_silent = silent()
            heard[0] = time.monotonic()
            child.cancel_goal_async()
            self.until(lambda: over.done() or (silent() and not was_silent), LIMIT if was_silent else math.inf)
            if was_silent or not over.done():
                raise Ending("abort", f"{name} was silent")
        leave()
        status, answer = over.result().status, over.result().result
        if status == GoalStatus.STATUS_SUCCEEDED:
            return answer
        if called_back:
            return None
        code = answer.error_code if client is self.arm else 0
        raise Ending("abort", f"{name} ended with status {status}: {answer.error_msg}", code)

    @staticmethod
    def send_back(future):
        if future.result().accepted:
            future.result().cancel_goal_async()


def main(args=None):
    rclpy.init(args=args)
    node = FetchServer()
    executor = MultiThreadedExecutor(num_threads=8)
    executor.add_node(node)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()
    executor.shutdown()
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
