"""Style: one thread and one timer that advances a generator; each stage yields until its condition holds."""

import math
import time

import rclpy
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import PoseStamped, WrenchStamped
from humanoid_interfaces.action import PickAndPlace
from humanoid_interfaces.msg import RobotState
from humanoid_interfaces.srv import ComputeArmIK
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

Result = PickAndPlace.Result
SIDE = "r"
JOINTS = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_yaw", "wrist_pitch", "wrist_roll")
RAISED = (0.7, -0.15, 0.0, -2.1, 0.0, 0.0, 0.0)
ABOVE = (-0.2, *RAISED[1:])  # the hand above whatever stands on the table
BEGINS = {"approaching": 0, "grasping": 25, "lifting": 40, "moving": 55, "placing": 70, "retreating": 85}
SHOULDER_Y = -0.17


def xyz(pose):
    p = pose.pose.position
    return p.x, p.y, p.z


def plus(a, b):
    return tuple(p + q for p, q in zip(a, b))


class Machine(Node):
    def __init__(self):
        super().__init__("pick_machine")
        self.hand = self.thing = self.state = None
        self.force = self.most = 0.0
        self.active = self.steps = self.waiting = self.over = self.watch = None
        self.stage, self.held, self.code, self.words = "approaching", False, Result.NONE, ""
        self.ticks = 0
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.arm = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self.fingers = self.create_publisher(Float64, f"{SIDE}_gripper/command", 10)
        self.ik = self.create_client(ComputeArmIK, "compute_arm_ik")
        self.create_subscription(PoseStamped, f"{SIDE}_hand/pose", lambda pose: setattr(self, "hand", pose), 10)
        self.create_subscription(WrenchStamped, f"{SIDE}_gripper/wrench", self.feel, 10)
        self.create_subscription(RobotState, "robot_state", lambda state: setattr(self, "state", state), latched)
        self.server = ActionServer(
            self,
            PickAndPlace,
            "pick_and_place",
            self.execute,
            goal_callback=self.judge,
            handle_accepted_callback=self.begin,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )
        self.create_timer(0.05, self.tick)

    def feel(self, wrench):
        self.force = wrench.wrench.force.y
        if self.active:
            self.most = max(self.most, self.force)

    def judge(self, request):
        place = request.place_pose
        if self.active or place.header.frame_id != "odom" or not all(map(math.isfinite, xyz(place))):
            return GoalResponse.REJECT
        if not math.isfinite(request.grasp_force) or request.grasp_force <= 0 or request.grasp_force > 25:
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def begin(self, handle):
        self.active, self.over = handle, Future()
        self.thing, self.most, self.held, self.stage = None, 0.0, False, "approaching"
        self.code, self.words, self.ticks = Result.NONE, "", 0
        self.steps = self.whole()
        self.waiting = None
        handle.execute()

    async def execute(self, handle):
        verb, result = await self.over
        getattr(handle, verb)()
        return result

    def tick(self):
        """Look at the alarms, then go on if what the generator waits for is there."""
        if self.active is None:
            return
        if self.state and self.state.mode == RobotState.FALLEN and self.code != Result.FELL:
            self.switch(Result.FELL, "fallen", iter(()))
        elif self.held and self.force < 1.0:
            self.switch(Result.DROPPED, "lost", self.away())
        elif self.active.is_cancel_requested and self.code == Result.NONE and not self.words:
            self.switch(Result.NONE, "canceled", self.tidy())
        try:
            while self.waiting is None or self.waiting():
                self.waiting = next(self.steps)
        except StopIteration:
            return self.finish()
        self.ticks += 1
        if self.ticks % 4 == 0 and self.hand and self.thing:
            self.tell()

    def switch(self, code, words, steps):
        self.code, self.words, self.steps, self.waiting = code, words, steps, None
        if code != Result.NONE:
            self.held = False

    def finish(self):
        verb = "abort" if self.code else "canceled" if self.active.is_cancel_requested else "succeed"
        result = Result(error_code=self.code, error_msg=self.words if self.code else "", max_grasp_force=self.most)
        if self.thing:
            result.final_object_pose = self.thing
        if self.watch:
            self.destroy_subscription(self.watch)
        self.watch, self.active = None, None
        self.over.set_result((verb, result))

    def tell(self):
        feedback = PickAndPlace.Feedback(stage=self.stage, hand_pose=self.hand, grasp_force=self.force)
        feedback.percent_complete = float(BEGINS[self.stage])
        feedback.distance_to_object = math.dist(xyz(self.hand), xyz(self.thing))
        self.active.publish_feedback(feedback)

    # what the generators wait for

    @staticmethod
    def after(seconds):
        end = time.monotonic() + seconds
        return lambda: time.monotonic() >= end

    @staticmethod
    def until(condition, seconds):
        end = time.monotonic() + seconds
        return lambda: condition() or time.monotonic() >= end

    # the task

    def whole(self):
        request = self.active.request
        place = xyz(request.place_pose)
        try:
            self.watch = self.create_subscription(
                PoseStamped, f"objects/{request.object_id}/pose", lambda pose: setattr(self, "thing", pose), 10
            )
        except Exception as error:  # no name for a topic
            return self.fail(Result.UNKNOWN_OBJECT, f"no object {request.object_id!r}: {error}")
        yield self.until(lambda: self.thing, 1.0)
        if self.thing is None:
            return self.fail(Result.UNKNOWN_OBJECT, f"no object {request.object_id!r}")
        self.home = xyz(self.thing)
        grasp = plus(self.home, (0, 0, 0.01))
        for target in (self.before(grasp), grasp, plus(place, (0, 0, 0.13)), plus(place, (0, 0, 0.01))):
            answer = yield from self.ask(target, self.yaw(target))
            if answer is None or answer.error_code != ComputeArmIK.Response.SUCCESS:
                return self.fail(Result.UNREACHABLE, answer.message if answer else "no inverse kinematics")

        self.fingers.publish(Float64(data=0.09))
        yield from self.posture(RAISED)
        for target, speed in ((self.before(grasp), 0.25), (grasp, 0.1)):
            if not (yield from self.line(target, self.yaw(grasp), speed)):
                yield from self.away()
                return self.fail(Result.GRASP_FAILED, "the hand does not get there")

        self.stage, opening = "grasping", 0.09
        while self.force < 1.0 and opening > 0:
            opening -= 0.0015
            self.fingers.publish(Float64(data=max(opening, 0.0)))
            yield self.after(0.04)
        for _ in range(12):  # a slow integral controller
            yield self.after(0.2)
            opening += 0.6 * (self.force - request.grasp_force) / 400.0
            self.fingers.publish(Float64(data=max(opening, 0.0)))
        if self.force < 1.0:
            yield from self.away()
            return self.fail(Result.GRASP_FAILED, "nothing between the fingers")

        self.stage, self.held = "lifting", True
        yield from self.line(plus(xyz(self.hand), (0, 0, 0.1)), self.yaw(grasp), 0.15)
        yield from self.deliver(place)
        yield from self.away()

    def deliver(self, place):
        self.stage = "moving"
        yield from self.shift(plus(place, (0, 0, 0.1)), 0.2)
        self.stage = "placing"
        yield from self.shift(plus(place, (0, 0, 0.015)), 0.15)
        yield from self.shift(place, 0.05)
        self.held = False

    def shift(self, place, speed):
        """Move the hand so that the thing in it comes to a place."""
        yield self.after(0.4)
        offset = plus(xyz(self.hand), [-c for c in xyz(self.thing)])
        yield from self.line(plus(place, offset), self.yaw(place), speed)

    def tidy(self):
        if self.held:
            here = xyz(self.thing)[:2]
            place = xyz(self.active.request.place_pose)
            back = math.dist(here, self.home[:2]) <= math.dist(here, place[:2])
            yield from self.deliver(self.home if back else place)
        yield from self.away()

    def away(self):
        self.stage = "retreating"
        if not (self.hand and self.thing):
            return
        self.fingers.publish(Float64(data=0.09))
        yield self.after(0.8)
        here = xyz(self.hand)
        if math.dist(here, xyz(self.thing)) < 0.1:
            yield from self.line(plus(here, (0, 0, 0.12)), self.yaw(here), 0.2)
            yield from self.posture(ABOVE)
        yield from self.posture(RAISED)

    def fail(self, code, words):
        self.code, self.words = code, words

    # the arm

    @staticmethod
    def yaw(point):
        return 0.5 * math.atan2(point[1] - SHOULDER_Y, point[0])

    def before(self, point):
        yaw = self.yaw(point)
        return plus(point, (-0.1 * math.cos(yaw), -0.1 * math.sin(yaw), 0))

    def posture(self, angles):
        self.send([angles], [1.4], [f"{SIDE}_{joint}" for joint in JOINTS])
        yield self.after(1.7)

    def line(self, target, yaw, speed):
        """Move the hand in a straight line; the last thing it says is whether the hand has come there."""
        start = xyz(self.hand)
        length = math.dist(start, target)
        count = max(1, round(length / 0.06))
        postures, times, names = [], [], []
        for n in range(1, count + 1):
            point = plus(start, [n / count * (b - a) for a, b in zip(start, target)])
            answer = yield from self.ask(point, yaw)
            if answer is None or answer.error_code != ComputeArmIK.Response.SUCCESS:
                return False
            names = answer.joint_state.name
            postures.append(answer.joint_state.position)
            times.append(max(0.4, length / speed) * n / count)
        self.send(postures, times, names)
        yield self.after(times[-1])
        yield self.until(lambda: math.dist(xyz(self.hand), target) < 0.013, 4.0)
        return math.dist(xyz(self.hand), target) < 0.02

    def ask(self, point, yaw):
        request = ComputeArmIK.Request(arm=SIDE, with_waist=False)
        request.hand_pose.header.frame_id = "odom"
        position, turn = request.hand_pose.pose.position, request.hand_pose.pose.orientation
        position.x, position.y, position.z = map(float, point)
        turn.z, turn.w = math.sin(yaw / 2), math.cos(yaw / 2)
        answer = self.ik.call_async(request)
        yield self.until(answer.done, 3.0)
        return answer.result() if answer.done() else None

    def send(self, postures, times, names):
        points = [
            JointTrajectoryPoint(
                positions=list(posture), time_from_start=Duration(sec=int(t), nanosec=int(t % 1 * 1e9))
            )
            for posture, t in zip(postures, times)
        ]
        self.arm.publish(JointTrajectory(joint_names=list(names), points=points))


def main(args=None):
    rclpy.init(args=args)
    node = Machine()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
