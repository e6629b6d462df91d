"""Style: a class, MultiThreadedExecutor and time.sleep in the execute callback; what ends a goal early is an exception."""

import math
import time

import rclpy
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, PoseStamped, WrenchStamped
from humanoid_interfaces.action import PickAndPlace
from humanoid_interfaces.msg import RobotState
from humanoid_interfaces.srv import ComputeArmIK
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.exceptions import NameValidationException
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
Feedback, Result = PickAndPlace.Feedback, PickAndPlace.Result

PERIOD = 0.05  # s, of the loop
FEEDBACK_PERIOD = 0.2  # s
PATIENCE = 1.0  # s for the object's topic
STAGE_LIMIT = 5.0  # s that the arm may take longer than planned

READY = {  # rad: the hand beside the body, above the table
    "r_shoulder_pitch": 0.7,
    "r_shoulder_roll": -0.15,
    "r_shoulder_yaw": 0.0,
    "r_elbow": -2.1,
    "r_wrist_yaw": 0.0,
    "r_wrist_pitch": 0.0,
    "r_wrist_roll": 0.0,
}
HIGH = {**READY, "r_shoulder_pitch": -0.2}  # rad: above all that stands on the table
READY_TIME = 1.5  # s
SHOULDER = (0.0, -0.17)  # m in odom
BACK = 0.10  # m, from where the hand goes to the object in a straight line
GRIP_ABOVE_CENTRE = 0.01  # m
LIFT = 0.12  # m
STRIDE = 0.06  # m between two points of a straight line
FAST, SLOW = 0.2, 0.1  # m/s
NEAR = 0.015  # m

WIDEST = 0.09  # m between the pads
CLOSING = 0.04  # m/s
PADS = 400.0  # N/m: a command that is 1 mm narrower presses with 0.4 N more
MOST_FORCE = 25.0  # N
TOUCH = 1.0  # N, below which nothing is held

SHARES = {  # of the whole task, percent, that are done when a stage begins
    Feedback.APPROACHING: 0.0,
    Feedback.GRASPING: 30.0,
    Feedback.LIFTING: 45.0,
    Feedback.MOVING: 60.0,
    Feedback.PLACING: 75.0,
    Feedback.RETREATING: 90.0,
}


class GiveUp(Exception):
    """Why a goal cannot be carried out: an error_code, and a reason for people."""

    def __init__(self, code, reason):
        super().__init__(reason)
        self.code = code


class Canceled(Exception):
    """The goal is to be cancelled."""


class Task:
    """What is known of the goal under way.

    Attributes:
        stage: one of the action's constants.
        object: its pose (PoseStamped), as last seen.
        taken_at: where it stood at first (Point).
        holds: whether the object hangs in the hand.
        may_be_canceled: False once a cancel was seen.
        most_force: N, the largest that was measured.
    """

    def __init__(self, goal_handle):
        self.handle = goal_handle
        self.object_id = goal_handle.request.object_id
        self.place = goal_handle.request.place_pose.pose.position
        self.wanted_force = goal_handle.request.grasp_force
        self.stage = Feedback.APPROACHING
        self.object = None
        self.taken_at = None
        self.holds = False
        self.may_be_canceled = True
        self.most_force = 0.0
        self.feedback_due = time.monotonic()


def raised(point, height, back=0.0):
    """Return the point `height` (m) above another, and `back` (m) from it towards the shoulder."""
    heading = heading_for(point)
    return Point(x=point.x - back * math.cos(heading), y=point.y - back * math.sin(heading), z=point.z + height)


def heading_for(point):
    """Return the way the hand points at a place (rad): half of the bearing from the shoulder spares the wrist."""
    return 0.5 * math.atan2(point.y - SHOULDER[1], point.x - SHOULDER[0])


def distance(one, other):
    return math.dist((one.x, one.y, one.z), (other.x, other.y, other.z))


class PickAndPlaceServer(Node):
    def __init__(self):
        super().__init__("pick_and_place_server")
        self._hand = None  # PoseStamped
        self._force = 0.0  # N, of the pad that presses less
        self._mode = None  # of robot_state
        self._busy = False
        self._trajectories = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self._gripper = self.create_publisher(Float64, "r_gripper/command", 10)
        self._arm_ik = self.create_client(ComputeArmIK, "compute_arm_ik")
        self.create_subscription(PoseStamped, "r_hand/pose", self._on_hand, 10)
        self.create_subscription(WrenchStamped, "r_gripper/wrench", self._on_wrench, 10)
        self.create_subscription(RobotState, "robot_state", self._on_state, LATCHED)
        self._server = ActionServer(
            self,
            PickAndPlace,
            "pick_and_place",
            execute_callback=self._execute,
            goal_callback=self._on_goal,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
        )

    def _on_hand(self, message):
        self._hand = message

    def _on_wrench(self, message):
        self._force = message.wrench.force.y

    def _on_state(self, message):
        self._mode = message.mode

    def _on_goal(self, request):
        if objection := self._objection(request):
            self.get_logger().warning(f"goal rejected: {objection}")
            return GoalResponse.REJECT
        self._busy = True
        return GoalResponse.ACCEPT

    def _objection(self, request):
        """Return why a goal cannot be carried out, or nothing."""
        place = request.place_pose.pose.position
        if request.place_pose.header.frame_id != "odom":
            return f"place_pose is in frame {request.place_pose.header.frame_id!r}, not in 'odom'"
        if not all(map(math.isfinite, (place.x, place.y, place.z))):
            return "place_pose holds a number that is not finite"
        if not 0.0 < request.grasp_force <= MOST_FORCE:  # nor is NaN
            return f"grasp_force is {request.grasp_force} N; expected more than 0, at most {MOST_FORCE}"
        if self._busy:
            return "the hand is busy with another goal"
        return ""

    def _execute(self, goal_handle):
        """Carry out the stages, one after the other; make one terminal call, return the result."""
        task, result = Task(goal_handle), Result()
        end = goal_handle.succeed
        watching = None
        try:
            watching = self._watch(task)
            try:
                self._pick_and_place(task)
            except Canceled:
                task.may_be_canceled = False
                self._put_away(task)
                end = goal_handle.canceled
        except GiveUp as reason:
            result.error_code, result.error_msg = reason.code, str(reason)
            end = goal_handle.abort
            self._let_go(task, reason.code)
        finally:
            if watching:
                self.destroy_subscription(watching)
            self._busy = False
        if task.object:
            result.final_object_pose = task.object
        result.max_grasp_force = task.most_force
        end()
        return result

    def _watch(self, task):
        """Subscribe to the object's pose."""

        def on_pose(message):
            task.object = message

        try:
            return self.create_subscription(PoseStamped, f"objects/{task.object_id}/pose", on_pose, 10)
        except NameValidationException:  # what is no name of a topic is no object either
            raise GiveUp(Result.UNKNOWN_OBJECT, f"{task.object_id!r} cannot be an object") from None

    def _pick_and_place(self, task):
        self._find(task)
        self._check_reach(task)
        self._approach(task)
        self._grasp(task)
        self._lift(task)
        self._carry(task, task.place)
        self._put_down(task, task.place)
        self._retreat(task)

    # -- the stages ---------------------------------------------------------------------------------------------------

    def _find(self, task):
        """Wait for the object's pose."""
        if not self._wait(task, lambda: task.object, PATIENCE):
            raise GiveUp(Result.UNKNOWN_OBJECT, f"nothing on objects/{task.object_id}/pose for {PATIENCE} s")
        task.taken_at = task.object.pose.position

    def _check_reach(self, task):
        """Ask for all places to which the hand must go, before anything moves."""
        for point in (
            raised(task.taken_at, GRIP_ABOVE_CENTRE, BACK),
            raised(task.taken_at, GRIP_ABOVE_CENTRE),
            raised(task.place, GRIP_ABOVE_CENTRE + LIFT),
            raised(task.place, GRIP_ABOVE_CENTRE),
        ):
            self._solve(task, point, heading_for(point))

    def _approach(self, task):
        """Bring the open hand around the object."""
        self._gripper.publish(Float64(data=WIDEST))
        self._move_joints(READY, READY_TIME)
        self._wait(task, lambda: False, READY_TIME + 0.2)
        heading = heading_for(task.taken_at)
        self._move_hand(task, raised(task.taken_at, GRIP_ABOVE_CENTRE, BACK), heading, FAST)
        self._move_hand(task, raised(task.taken_at, GRIP_ABOVE_CENTRE), heading, SLOW)

    def _grasp(self, task):
        """Close the fingers until they touch the object, then press with the force that was asked for."""
        task.stage = Feedback.GRASPING
        opening = WIDEST
        while opening > 0.0 and self._force < TOUCH:
            opening = max(0.0, opening - CLOSING * PERIOD)
            self._gripper.publish(Float64(data=opening))
            self._wait(task, lambda: False, PERIOD)
        for _ in range(5):
            self._wait(task, lambda: False, 0.4)
            missing = task.wanted_force - self._force
            if self._force < TOUCH or abs(missing) < 0.05 * task.wanted_force:
                break
            opening = max(0.0, opening - missing / PADS)
            self._gripper.publish(Float64(data=opening))
        if self._force < TOUCH:
            raise GiveUp(Result.GRASP_FAILED, f"the fingers feel {self._force:.1f} N: nothing is between them")

    def _lift(self, task):
        task.stage = Feedback.LIFTING
        task.holds = True
        up = Point(x=self._grip.x, y=self._grip.y, z=self._grip.z + LIFT)
        self._move_hand(task, up, heading_for(task.taken_at), FAST)

    def _carry(self, task, place):
        """Bring the object above a place."""
        task.stage = Feedback.MOVING
        heading = heading_for(place)
        self._move_hand(task, self._grip_for(task, raised(place, LIFT)), heading, FAST)
        self._wait(task, lambda: False, 0.4)  # until it hangs still

    def _put_down(self, task, place):
        """Lower the object until it stands at a place, and let go."""
        task.stage = Feedback.PLACING
        heading = heading_for(place)
        self._move_hand(task, self._grip_for(task, raised(place, 0.03)), heading, FAST)
        self._wait(task, lambda: False, 0.3)
        self._move_hand(task, self._grip_for(task, place), heading, SLOW)
        self._wait(task, lambda: False, 0.2)
        task.holds = False

    def _retreat(self, task):
        """Open the hand and withdraw it."""
        task.stage = Feedback.RETREATING
        self._gripper.publish(Float64(data=WIDEST))
        self._wait(task, lambda: False, 0.6)
        if distance(self._grip, task.object.pose.position) < BACK:
            try:  # not straight back: there the arm has to turn over, and its hand strays
                self._move_hand(task, raised(self._grip, LIFT), heading_for(self._grip), FAST)
            except GiveUp as reason:
                if reason.code == Result.FELL:
                    raise
            self._move_joints(HIGH, READY_TIME)
            self._wait(task, lambda: False, READY_TIME)
        self._move_joints(READY, READY_TIME)
        self._wait(task, lambda: False, READY_TIME + 0.2)

    def _put_away(self, task):
        """End in safety: put down what is held where it was taken or shall stand, whichever is nearer; withdraw."""
        if task.holds:
            here = task.object.pose.position
            place = min((task.taken_at, task.place), key=lambda spot: math.hypot(spot.x - here.x, spot.y - here.y))
            self._carry(task, place)
            self._put_down(task, place)
        if task.object:
            self._retreat(task)

    def _let_go(self, task, code):
        """Withdraw after a failure on the way."""
        if code == Result.DROPPED or (code == Result.GRASP_FAILED and not task.holds):
            task.may_be_canceled = task.holds = False
            try:
                self._retreat(task)
            except GiveUp as reason:
                self.get_logger().warning(f"the hand was not withdrawn: {reason}")

    # -- the arm ------------------------------------------------------------------------------------------------------

    @property
    def _grip(self):
        """The point between the pads."""
        return self._hand.pose.position

    def _grip_for(self, task, place):
        """Return where the hand must be for the object that it holds to be at a place."""
        here = task.object.pose.position
        return Point(
            x=self._grip.x + place.x - here.x,
            y=self._grip.y + place.y - here.y,
            z=self._grip.z + place.z - here.z,
        )

    def _move_hand(self, task, target, heading, speed):
        """Move the hand in a straight line to a point, and wait until it is there."""
        start, length = self._grip, distance(self._grip, target)
        strides, seconds = max(1, math.ceil(length / STRIDE)), max(0.3, length / speed)
        names, points = [], []
        for number in range(1, strides + 1):
            share = number / strides
            between = Point(
                x=start.x + share * (target.x - start.x),
                y=start.y + share * (target.y - start.y),
                z=start.z + share * (target.z - start.z),
            )
            angles = self._solve(task, between, heading)
            names = list(angles)
            points.append(
                JointTrajectoryPoint(positions=list(angles.values()), time_from_start=duration(share * seconds))
            )
        self._trajectories.publish(JointTrajectory(joint_names=names, points=points))
        arrival = time.monotonic() + seconds
        there = lambda: time.monotonic() >= arrival and distance(self._grip, target) < NEAR
        if not self._wait(task, there, seconds + STAGE_LIMIT):
            raise GiveUp(Result.GRASP_FAILED, f"the hand did not arrive while {task.stage}")

    def _move_joints(self, angles, seconds):
        point = JointTrajectoryPoint(positions=list(angles.values()), time_from_start=duration(seconds))
        self._trajectories.publish(JointTrajectory(joint_names=list(angles), points=[point]))

    def _solve(self, task, point, heading):
        """Return the arm's angles (rad, by joint) that bring the hand to a point."""
        request = ComputeArmIK.Request(arm="r")
        request.hand_pose.header.frame_id = "odom"
        request.hand_pose.pose.position = point
        request.hand_pose.pose.orientation.z = math.sin(heading / 2)
        request.hand_pose.pose.orientation.w = math.cos(heading / 2)
        answer = self._arm_ik.call_async(request)
        if not self._wait(task, answer.done, 3.0):
            raise GiveUp(Result.UNREACHABLE, "compute_arm_ik does not answer")
        if answer.result().error_code != ComputeArmIK.Response.SUCCESS:
            raise GiveUp(Result.UNREACHABLE, answer.result().message)
        return dict(zip(answer.result().joint_state.name, answer.result().joint_state.position))

    # -- while anything goes on ---------------------------------------------------------------------------------------

    def _wait(self, task, condition, limit):
        """Wait for a condition, at most `limit` s, and return whether it came; look at everything meanwhile."""
        end = time.monotonic() + limit
        while not condition():
            if time.monotonic() >= end:
                return False
            self._look(task)
            time.sleep(PERIOD)
        return True

    def _look(self, task):
        """Notice what ends the goal, and publish feedback when it is due."""
        if not rclpy.ok() or self._mode == RobotState.FALLEN:
            raise GiveUp(Result.FELL, "the robot has fallen")
        if task.may_be_canceled and task.handle.is_cancel_requested:
            raise Canceled
        if task.holds and self._force < TOUCH:
            raise GiveUp(Result.DROPPED, f"{task.object_id} was lost while {task.stage}")
        task.most_force = max(task.most_force, self._force)
        now = time.monotonic()
        if now >= task.feedback_due and self._hand and task.object:
            task.feedback_due = now + FEEDBACK_PERIOD - PERIOD / 2
            self._publish_feedback(task)

    def _publish_feedback(self, task):
        feedback = Feedback(stage=task.stage, percent_complete=SHARES[task.stage])
        feedback.hand_pose = self._hand
        feedback.distance_to_object = distance(self._grip, task.object.pose.position)
        feedback.grasp_force = self._force
        task.handle.publish_feedback(feedback)


def duration(seconds):
    return Duration(sec=int(seconds), nanosec=int(seconds % 1 * 1e9))


def main(args=None):
    rclpy.init(args=args)
    node = PickAndPlaceServer()
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
