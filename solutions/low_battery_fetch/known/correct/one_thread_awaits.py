"""Style: one thread; an async execute callback awaits short pauses, and looks after its child in between."""

import math

import rclpy
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from humanoid_interfaces.action import NavigateToPose, PickAndPlace
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from sensor_msgs.msg import BatteryState

NAVIGATE, PICK = "navigate_to_pose", "pick_and_place"
TABLE = (1.2, 0.0, 0.0)  # x, y, z in odom, m; the heading is 0
TRAY = (1.45, 0.0, 0.72)
HOME = (0.0, 0.0, 0.0)
LOW = 0.20
PATIENCE = 5.0  # s without a sign of a child
TICK = 0.1  # s
EMPTY_HANDED = ("", PickAndPlace.Feedback.APPROACHING, PickAndPlace.Feedback.GRASPING)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Canceled(Exception):
    """The fetch was canceled, and none of its children is at work any more."""


class Failed(Exception):
    """The fetch ends ABORTED with a code and a reason."""

    def __init__(self, reason, code=PickAndPlace.Result.NONE):
        super().__init__(reason)
        self.code = code


class Child:
    """A goal that this server sends to another one."""

    def __init__(self, name, now):
        self.name = name
        self.heard = now  # s, when it last gave a sign
        self.stage = ""  # of the arm, in its last feedback
        self.handle = None  # once it is accepted
        self.ended = None  # the future of its result
        self.asked = False  # whether it was asked to stop
        self.silent = False  # whether that was for its silence


class Fetch(Node):
    def __init__(self):
        super().__init__("fetch")
        self._level = None  # the last percentage of the battery
        self._was_low = False  # since the fetch began: a battery that rests recovers for a moment
        self._latest = None  # the goal that came last
        self._active = None  # the goal that is fetched now
        self._clients_of = {
            NAVIGATE: ActionClient(self, NavigateToPose, NAVIGATE),
            PICK: ActionClient(self, PickAndPlace, PICK),
        }
        self.create_subscription(BatteryState, "battery_state", self._on_battery, LATCHED)
        self._server = ActionServer(
            self,
            PickAndPlace,
            "fetch",
            self._execute,
            goal_callback=self._on_goal,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=lambda _goal_handle: CancelResponse.ACCEPT,
        )

    def _on_battery(self, message):
        if 0.0 <= message.percentage <= 1.0:  # NaN is not
            self._level = message.percentage
            self._was_low = self._was_low or self._level < LOW

    def _on_goal(self, goal):
        """Reject what can never be fetched."""
        pose = goal.place_pose.pose
        numbers = [getattr(pose.position, axis) for axis in "xyz"]
        numbers += [getattr(pose.orientation, axis) for axis in "xyzw"]
        if goal.place_pose.header.frame_id != "odom" or not all(map(math.isfinite, numbers)):
            return GoalResponse.REJECT
        if not (math.isfinite(goal.grasp_force) and goal.grasp_force > 0.0):
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _on_accepted(self, goal_handle):
        self._latest = goal_handle
        goal_handle.execute()

    async def _execute(self, goal_handle):
        while self._active is not None:  # the goal before ends first
            await self._pause()
        self._active = goal_handle
        result = PickAndPlace.Result()
        try:
            await self._fetch(goal_handle, result)
            goal_handle.succeed()
        except Canceled:
            goal_handle.canceled()
        except Failed as failure:
            result.error_code, result.error_msg = failure.code, str(failure)
            goal_handle.abort()
        finally:
            self._active = None
        return result

    async def _fetch(self, goal_handle, result):
        """Walk, take, walk, put down. Once the battery is low, nothing but the walk home is begun."""
        request = goal_handle.request
        self._was_low = False
        if self._level is None or self._level < LOW:
            raise Failed(f"the battery is low, or its level unknown: {self._level}")
        await self._run(goal_handle, NAVIGATE, walk_to(TABLE))
        if not self._was_low:
            note(result, await self._run(goal_handle, PICK, put(request, pose_at(TRAY))))
        await self._run(goal_handle, NAVIGATE, walk_to(HOME), homeward=True)
        if self._was_low:
            raise Failed("gave up: the battery got low")
        answer = await self._run(goal_handle, PICK, put(request, request.place_pose))
        if answer is None:
            raise Failed("gave up at home: the battery is low, and the object is on the tray")
        note(result, answer)

    async def _run(self, goal_handle, name, goal, homeward=False):
        """Run one child to its end; return its result, None if it was canceled for the battery."""
        client = self._clients_of[name]
        if not await self._wait(client.server_is_ready):
            raise Failed(f"nobody offers {name}")
        self._raise_if_stopped(goal_handle)
        child = Child(name, self._now())
        child.handle = await self._accepted(goal_handle, child, client, goal)
        child.ended = child.handle.get_result_async()
        if child.ended is None:
            raise Failed("step 2 is not written yet")
        while not child.ended.done():
            self._look_after(goal_handle, child, homeward)
            await self._pause()
        return self._result_of(goal_handle, child)

    async def _accepted(self, goal_handle, child, client, goal):
        """Send a goal and return its handle, once it is accepted."""
        accepting = None
        accepting = client.send_goal_async(
            goal, feedback_callback=lambda message: self._on_feedback(goal_handle, child, message)
        )
        if accepting is None:
            raise Failed("step 1 is not written yet")
        if not await self._wait(accepting.done):
            # It may still be accepted, when nobody waits for it any more.
            accepting.add_done_callback(cancel_if_accepted)
            raise Failed(f"{child.name} did not answer its goal")
        handle = accepting.result()
        if not handle.accepted:
            raise Failed(f"{child.name} rejected its goal")
        child.heard = self._now()
        return handle

    def _on_feedback(self, goal_handle, child, message):
        child.heard = child.heard if child.silent else self._now()  # once silent, only its result counts
        if child.name == PICK:
            child.stage = message.feedback.stage
            goal_handle.publish_feedback(message.feedback)

    def _look_after(self, goal_handle, child, homeward):
        """Look, ten times a second, whether a child that is at work should stop."""
        if not child.asked and self._should_stop(goal_handle, child, homeward):
            child.asked = True
            child.handle.cancel_goal_async()
        if self._now() - child.heard > PATIENCE:
            if child.silent:
                raise Failed(f"{child.name} is silent, also after the cancel")
            child.silent = child.asked = True
            child.heard = self._now()
            child.handle.cancel_goal_async()

    def _should_stop(self, goal_handle, child, homeward):
        """Return whether a child should be canceled: fetch is, a newer goal came, or the battery is low."""
        if goal_handle.is_cancel_requested or goal_handle is not self._latest:
            return True
        if self._was_low and not homeward and child.stage in EMPTY_HANDED:
            return True
        return False

    def _result_of(self, goal_handle, child):
        """Return the result of a child that has ended, None if it was canceled for the battery."""
        answer = child.ended.result()
        if child.silent:
            raise Failed(f"{child.name} was silent for {PATIENCE:g} s")
        self._raise_if_stopped(goal_handle)
        if answer.status == GoalStatus.STATUS_SUCCEEDED:
            return answer.result
        if child.asked:
            return None
        code = answer.result.error_code if child.name == PICK else PickAndPlace.Result.NONE
        if answer.status == GoalStatus.STATUS_ABORTED:
            raise Failed(f"{child.name} was aborted: {answer.result.error_msg}", code)
        raise Failed(f"{child.name} ended with status {answer.status}")

    def _raise_if_stopped(self, goal_handle):
        """End the fetch if it is canceled, or if a newer goal has come."""
        if goal_handle.is_cancel_requested:
            raise Canceled
        if goal_handle is not self._latest:
            raise Failed("a newer goal came", PickAndPlace.Result.PREEMPTED)

    async def _wait(self, condition):
        """Wait until a condition holds; return False after 5 s."""
        until = self._now() + PATIENCE
        while not condition():
            if self._now() > until:
                return False
            await self._pause()
        return True

    async def _pause(self):
        over = Future()
        timer = self.create_timer(TICK, lambda: over.set_result(None))
        await over
        self.destroy_timer(timer)

    def _now(self):
        return self.get_clock().now().nanoseconds / 1e9


def cancel_if_accepted(accepting):
    """Cancel a goal that was accepted when nobody waited for it any more."""
    if accepting.result().accepted:
        accepting.result().cancel_goal_async()


def pose_at(position):
    """Return a pose in odom with a heading of 0."""
    pose = PoseStamped()
    pose.header.frame_id = "odom"
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = position
    pose.pose.orientation.w = 1.0
    return pose


def walk_to(place):
    return NavigateToPose.Goal(pose=pose_at(place))


def put(request, place_pose):
    """Return the goal for the arm: what fetch was asked for, put down somewhere."""
    return PickAndPlace.Goal(object_id=request.object_id, place_pose=place_pose, grasp_force=request.grasp_force)


def note(result, answer):
    """Keep what the arm reports; None: it was canceled."""
    if answer is not None:
        result.final_object_pose = answer.final_object_pose
        result.max_grasp_force = max(result.max_grasp_force, answer.max_grasp_force)


def main(args=None):
    rclpy.init(args=args)
    node = Fetch()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
