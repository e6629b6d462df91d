"""Style: one thread; an async execute callback that awaits timers and answers; a new goal takes the hand from the old one."""

import math

import rclpy
from geometry_msgs.msg import Point, PoseStamped, WrenchStamped
from humanoid_interfaces.action import PickAndPlace
from humanoid_interfaces.msg import RobotState
from humanoid_interfaces.srv import ComputeArmIK
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.duration import Duration
from rclpy.exceptions import InvalidTopicNameException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.task import Future
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

Feedback, Result = PickAndPlace.Feedback, PickAndPlace.Result
STAGES = ["approaching", "grasping", "lifting", "moving", "placing", "retreating"]
ARM = ["shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_yaw", "wrist_pitch", "wrist_roll"]
READY = dict(zip(["waist_yaw", *("r_" + part for part in ARM)], [0.0, 0.7, -0.15, 0.0, -2.1, 0.0, 0.0, 0.0]))
TICK = 0.05


class End(Exception):
    """The goal ends otherwise than hoped: by a verb of its handle, with a code and a reason."""

    def __init__(self, verb, code, reason):
        super().__init__(reason)
        self.verb, self.code = verb, code


class Job:
    """One goal and what has come of it."""

    def __init__(self, handle):
        self.handle = handle
        self.goal = handle.request.place_pose.pose.position
        self.force = handle.request.grasp_force
        self.stage = 0
        self.seen = None  # PoseStamped of the object
        self.home = None  # where it stood
        self.touched = False  # something has moved
        self.lifted = False
        self.firm = True  # may still be stopped
        self.most = 0.0
        self.ticks = 0


def along(point, metres, up=0.0):
    """Return the point so far ahead of another, as the hand points there, and so far above it."""
    yaw = yaw_at(point)
    return Point(x=point.x + metres * math.cos(yaw), y=point.y + metres * math.sin(yaw), z=point.z + up)


def yaw_at(point):
    return 0.5 * math.atan2(point.y + 0.17, point.x)


def gap(a, b):
    return math.hypot(a.x - b.x, a.y - b.y, a.z - b.z)


class Fetcher(Node):
    def __init__(self):
        super().__init__("fetcher")
        self.hand = self.mode = self.newest = self.turn = None
        self.force = 0.0
        self.fingers = 0.0
        self.arm = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self.gripper = self.create_publisher(Float64, "r_gripper/command", 10)
        self.ik = self.create_client(ComputeArmIK, "compute_arm_ik")
        self.create_subscription(PoseStamped, "r_hand/pose", self.on_hand, 10)
        self.create_subscription(WrenchStamped, "r_gripper/wrench", self.on_wrench, 10)
        self.create_subscription(JointState, "joint_states", self.on_joints, qos_profile_sensor_data)
        self.create_subscription(RobotState, "robot_state", self.on_state, 10)
        self.server = ActionServer(
            self,
            PickAndPlace,
            "pick_and_place",
            self.execute,
            goal_callback=self.on_goal,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=self.on_cancel,
        )

    def on_hand(self, message):
        self.hand = message

    def on_wrench(self, message):
        self.force = message.wrench.force.y

    def on_joints(self, message):
        place = dict(zip(message.name, message.position))
        self.fingers = place["r_finger_1"] + place["r_finger_2"]

    def on_state(self, message):
        self.mode = message.mode

    def on_goal(self, request):
        pose, force = request.place_pose, request.grasp_force
        at = pose.pose.position
        sound = pose.header.frame_id == "odom" and math.isfinite(at.x + at.y + at.z) and 0 < force <= 25
        return GoalResponse.ACCEPT if sound else GoalResponse.REJECT

    def on_cancel(self, handle):
        return CancelResponse.ACCEPT

    def on_accepted(self, handle):
        self.newest = handle
        handle.execute()

    async def execute(self, handle):
        before, mine = self.turn, Future()
        self.turn = mine
        if before is not None:
            await before  # until the older goal has put down what it holds
        try:
            return await self.serve(Job(handle))
        finally:
            mine.set_result(None)

    async def serve(self, job):
        topic = f"objects/{job.handle.request.object_id}/pose"
        watching, verb, code, reason = None, "succeed", Result.NONE, ""
        try:
            try:
                watching = self.create_subscription(PoseStamped, topic, lambda pose: setattr(job, "seen", pose), 10)
                await self.fetch(job)
            except InvalidTopicNameException:
                raise End("abort", Result.UNKNOWN_OBJECT, f"{topic} cannot be a topic") from None
            except End as end:
                if end.code not in (Result.NONE, Result.PREEMPTED):
                    raise
                job.firm = False
                await self.clean_up(job)
                verb, code, reason = end.verb, end.code, str(end)
        except End as end:
            verb, code, reason = end.verb, end.code, str(end)
            if code in (Result.GRASP_FAILED, Result.DROPPED):
                job.firm = job.lifted = False
                try:
                    await self.leave(job)
                except End as trouble:
                    self.get_logger().warning(f"the hand was not withdrawn: {trouble}")
        if watching:
            self.destroy_subscription(watching)
        result = Result(error_code=code, error_msg=reason, max_grasp_force=job.most)
        result.final_object_pose = job.seen or PoseStamped()
        getattr(job.handle, verb)()
        return result

    async def fetch(self, job):
        for _ in range(20):
            if job.seen:
                break
            await self.sleep(job)
        else:
            raise End("abort", Result.UNKNOWN_OBJECT, "there is no such object")
        job.home = job.seen.pose.position
        cup = along(job.home, 0.0, 0.01)
        for point in (along(cup, -0.1), cup, along(job.goal, 0.0, 0.13), along(job.goal, 0.0, 0.01)):
            await self.angles(job, point, yaw_at(point))

        job.touched = True
        self.gripper.publish(Float64(data=0.09))
        await self.follow(job, [READY], [1.5])
        await self.reach(job, along(cup, -0.1), yaw_at(cup), 0.2)
        await self.reach(job, cup, yaw_at(cup), 0.1)

        job.stage = 1
        await self.close(job)

        job.stage = 2
        job.lifted = True
        await self.reach(job, along(self.hand.pose.position, 0.0, 0.12), yaw_at(cup), 0.2)
        await self.bring(job, job.goal)
        await self.leave(job)

    async def bring(self, job, spot):
        """Carry what is held to a spot and set it down."""
        job.stage = 3
        for height, speed in ((0.12, 0.2), (0.02, 0.15), (0.001, 0.08)):
            if height < 0.1:
                job.stage = 4
            grip, thing = self.hand.pose.position, job.seen.pose.position
            target = Point(
                x=spot.x + grip.x - thing.x, y=spot.y + grip.y - thing.y, z=spot.z + height + grip.z - thing.z
            )
            await self.reach(job, target, yaw_at(spot), speed)
            await self.sleep(job, 0.4)
        job.lifted = False

    async def leave(self, job):
        job.stage = 5
        self.gripper.publish(Float64(data=0.09))
        await self.sleep(job, 0.7)
        if gap(self.hand.pose.position, job.seen.pose.position) < 0.1:
            here = self.hand.pose.position
            await self.reach(job, along(here, -0.1), yaw_at(here), 0.2)
        await self.follow(job, [READY], [1.5])

    async def clean_up(self, job):
        if job.lifted:
            thing = job.seen.pose.position
            await self.bring(job, min(job.home, job.goal, key=lambda spot: (spot.x - thing.x) ** 2 + (spot.y - thing.y) ** 2))
        if job.touched:
            await self.leave(job)

    async def close(self, job):
        """Close until both pads feel something; from how far they are apart then follows what to command."""
        for step in range(46):
            self.gripper.publish(Float64(data=0.09 - 0.002 * step))
            await self.sleep(job)
            if self.force > 1.0:
                break
        await self.sleep(job, 0.3)
        if self.force < 1.0:
            raise End("abort", Result.GRASP_FAILED, "the hand is empty")
        self.gripper.publish(Float64(data=self.fingers - job.force / 400.0))
        await self.sleep(job, 0.6)

    async def reach(self, job, target, yaw, speed):
        """Move the hand in a straight line; wait until it is there."""
        start = self.hand.pose.position
        length = gap(start, target)
        parts = 1 + int(length / 0.05)
        stops, times = [], []
        for part in range(1, parts + 1):
            share = part / parts
            stops.append(
                await self.angles(
                    job,
                    Point(
                        x=start.x + share * (target.x - start.x),
                        y=start.y + share * (target.y - start.y),
                        z=start.z + share * (target.z - start.z),
                    ),
                    yaw,
                )
            )
            times.append(share * max(0.4, length / speed))
        await self.follow(job, stops, times)
        for _ in range(100):
            if gap(self.hand.pose.position, target) < 0.012:
                return
            await self.sleep(job)
        raise End("abort", Result.GRASP_FAILED, "the hand did not get there")

    async def follow(self, job, stops, times):
        message = JointTrajectory(joint_names=list(stops[0]))
        for stop, seconds in zip(stops, times):
            after = Duration(seconds=seconds).to_msg()
            message.points.append(JointTrajectoryPoint(positions=list(stop.values()), time_from_start=after))
        self.arm.publish(message)
        await self.sleep(job, times[-1] + 0.1)

    async def angles(self, job, point, yaw):
        request = ComputeArmIK.Request(arm="r", with_waist=True)
        request.hand_pose.header.frame_id = "odom"
        request.hand_pose.pose.position = point
        request.hand_pose.pose.orientation.z, request.hand_pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        answer = self.ik.call_async(request)
        for _ in range(80):
            if answer.done():
                break
            await self.sleep(job)
        else:
            raise End("abort", Result.UNREACHABLE, "no answer from compute_arm_ik")
        state = answer.result().joint_state
        if answer.result().error_code != ComputeArmIK.Response.SUCCESS:
            raise End("abort", Result.UNREACHABLE, answer.result().message)
        return dict(zip(state.name, state.position))

    async def sleep(self, job, seconds=TICK):
        """Let time pass, and look around every 50 ms."""
        for _ in range(max(1, round(seconds / TICK))):
            done = Future()
            timer = self.create_timer(TICK, lambda done=done: done.set_result(None))
            try:
                await done
            finally:
                self.destroy_timer(timer)
            self.look(job)

    def look(self, job):
        job.most = max(job.most, self.force)
        if self.mode == RobotState.FALLEN:
            raise End("abort", Result.FELL, "the robot lies on the floor")
        if job.lifted and self.force < 0.8:
            raise End("abort", Result.DROPPED, "the object is gone")
        if job.firm and job.handle.is_cancel_requested:
            raise End("canceled", Result.NONE, "")
        if job.firm and job.handle is not self.newest:
            raise End("abort", Result.PREEMPTED, "a later goal has the hand")
        job.ticks += 1
        if job.ticks % 4 == 0 and job.seen and self.hand:
            feedback = Feedback(
                stage=STAGES[job.stage],
                percent_complete=100.0 * job.stage / len(STAGES),
                hand_pose=self.hand,
                distance_to_object=gap(self.hand.pose.position, job.seen.pose.position),
                grasp_force=self.force,
            )
            job.handle.publish_feedback(feedback)


def main(args=None):
    rclpy.init(args=args)
    node = Fetcher()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
