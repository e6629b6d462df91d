"""Style: one thread and no waiting; the plan is a generator, and a timer lets it go on ten times a second."""

import math
import time

import rclpy
from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import NavigateToPose, PickAndPlace
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from sensor_msgs.msg import BatteryState

SILENCE = 5.0
FREE = ("", "approaching", "grasping")  # stages in which the hand holds nothing


class Fetching:
    """One goal of `fetch`: its plan, and what has been heard of the child at work."""

    def __init__(self, handle, robot):
        self.handle = handle
        self.robot = robot
        self.result = PickAndPlace.Result()
        self.over = Future()
        self.replaced = False
        self.started = False
        self.stage = ""
        self.heard = 0.0
        self.plan = self.make_plan()

    def go_on(self):
        """Let the plan go on a little; return whether it has come to its end."""
        try:
            next(self.plan)
        except StopIteration as end:
            finish, self.result.error_msg, self.result.error_code = end.value
            getattr(self.handle, finish)()
            self.over.set_result(None)
            return True
        return False

    def make_plan(self):
        request, robot = self.handle.request, self.robot
        tired = "the battery is low"
        robot.was_low = robot.level is None or robot.level < 0.20
        if robot.was_low:
            return "abort", f"{tired}, or nobody knows its level", 0
        pick_up = PickAndPlace.Goal(object_id=request.object_id, grasp_force=request.grasp_force)
        pick_up.place_pose = at(1.45, 0.0, 0.72)
        put_down = PickAndPlace.Goal(object_id=request.object_id, grasp_force=request.grasp_force)
        put_down.place_pose = request.place_pose
        steps = [
            (robot.walks, NavigateToPose.Goal(pose=at(1.2, 0.0, 0.0)), False),
            (robot.grasps, pick_up, False),
            (robot.walks, NavigateToPose.Goal(pose=at(0.0, 0.0, 0.0)), True),
            (robot.grasps, put_down, False),
        ]
        for number, (client, goal, homeward) in enumerate(steps, start=1):
            if robot.was_low and not homeward and number > 1:
                if number == 4:
                    return "abort", f"{tired}: the robot is home, and puts nothing down", 0
                continue
            problem = yield from self.child(client, goal, homeward)
            if problem == tired and number == 4:
                return "abort", f"{tired}: the object is still on the tray", 0
            if problem and problem != tired:
                return problem
        return "succeed", "", 0

    def child(self, client, goal, homeward):
        """Carry out a step; return nothing when it is done, "the battery is low", or how the fetch ends."""
        name = "navigate_to_pose" if client is self.robot.walks else "pick_and_place"
        since = time.monotonic()
        while not client.server_is_ready():
            if time.monotonic() - since > SILENCE:
                return "abort", f"{name} is offered by nobody", 0
            yield
        if self.is_stopped():
            return self.how_it_stops()
        self.stage = ""
        accepting = client.send_goal_async(goal, feedback_callback=self.on_feedback)
        since = time.monotonic()
        while not accepting.done():
            if time.monotonic() - since > SILENCE:
                accepting.add_done_callback(call_back)
                return "abort", f"{name} gives no answer", 0
            yield
        at_work = accepting.result()
        if not at_work.accepted:
            return "abort", f"{name} rejects it", 0
        self.heard = time.monotonic()
        ending = at_work.get_result_async()
        asked, given_up = False, None
        while not ending.done():
            if given_up and time.monotonic() - given_up > SILENCE:
                return "abort", f"{name} is silent, and its end unknown", 0
            if not given_up and time.monotonic() - self.heard > SILENCE:
                given_up, asked = time.monotonic(), True
                at_work.cancel_goal_async()
            tired = self.robot.was_low and not homeward and self.stage in FREE
            if not asked and (tired or self.is_stopped()):
                asked = True
                at_work.cancel_goal_async()
            yield
        if given_up:
            return "abort", f"{name} was silent", 0
        if self.is_stopped():
            return self.how_it_stops()
        status, answer = ending.result().status, ending.result().result
        if status == GoalStatus.STATUS_SUCCEEDED:
            if client is self.robot.grasps:
                self.result.final_object_pose = answer.final_object_pose
                self.result.max_grasp_force = max(self.result.max_grasp_force, answer.max_grasp_force)
            return None
        if asked:
            return "the battery is low"
        return "abort", f"{name}: {answer.error_msg}", answer.error_code if client is self.robot.grasps else 0

    def on_feedback(self, message):
        self.heard = time.monotonic()
        if isinstance(message.feedback, PickAndPlace.Feedback):
            self.stage = message.feedback.stage
            self.handle.publish_feedback(message.feedback)

    def is_stopped(self):
        return self.replaced or self.handle.is_cancel_requested

    def how_it_stops(self):
        if self.handle.is_cancel_requested:
            return "canceled", "", 0
        return "abort", "preempted", PickAndPlace.Result.PREEMPTED


class Robot:
    """The two actions, the battery, and the fetches that wait for their turn."""

    def __init__(self, node):
        self.level = None
        self.was_low = False
        self.queue = []
        self.by_id = {}
        together = ReentrantCallbackGroup()
        self.walks = ActionClient(node, NavigateToPose, "navigate_to_pose", callback_group=together)
        self.grasps = ActionClient(node, PickAndPlace, "pick_and_place", callback_group=together)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_subscription(BatteryState, "battery_state", self.on_battery, latched)
        self.server = ActionServer(
            node,
            PickAndPlace,
            "fetch",
            self.execute,
            goal_callback=accept,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=together,
        )
        node.create_timer(0.1, self.on_timer, callback_group=together)

    def on_battery(self, message):
        if 0.0 <= message.percentage <= 1.0:
            self.level = message.percentage
            if self.level < 0.20:
                self.was_low = True

    def on_accepted(self, handle):
        for earlier in self.queue:
            earlier.replaced = True
        fetching = Fetching(handle, self)
        self.queue.append(fetching)
        self.by_id[bytes(handle.goal_id.uuid)] = fetching
        handle.execute()

    async def execute(self, handle):
        fetching = self.by_id.pop(bytes(handle.goal_id.uuid))
        fetching.started = True
        await fetching.over
        return fetching.result

    def on_timer(self):
        if self.queue and self.queue[0].started and self.queue[0].go_on():
            self.queue.pop(0)


def accept(request):
    p, q = request.place_pose.pose.position, request.place_pose.pose.orientation
    numbers = (p.x, p.y, p.z, q.x, q.y, q.z, q.w, request.grasp_force)
    good = all(map(math.isfinite, numbers)) and request.grasp_force > 0
    return GoalResponse.ACCEPT if good and request.place_pose.header.frame_id == "odom" else GoalResponse.REJECT


def at(x, y, z):
    pose = NavigateToPose.Goal().pose
    pose.header.frame_id = "odom"
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
    pose.pose.orientation.w = 1.0
    return pose


def call_back(accepting):
    if accepting.result().accepted:
        accepting.result().cancel_goal_async()


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("fetch")
    robot = Robot(node)  # noqa: F841
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
