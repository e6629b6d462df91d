"""Makes messages of the ground truth: postures at 25 Hz, and the robot's mode and battery when they change."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from geometry_msgs.msg import Pose, PoseStamped, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.recording.definitions import TFMessage
from autograder.recording.entry import Entry, full_name, stamp
from humanoid_interfaces.msg import RobotState

TF = "/tf"


def robot_messages(transcript: Transcript, namespace: str) -> Iterator[Entry]:
    """Yield robot_state and battery_state and, if postures were recorded, odom, joint_states, objects' poses and tf."""
    yield from _postures(transcript, namespace)
    yield from _states(transcript, full_name(namespace, "robot_state"))
    for event in transcript.all(ev.BatteryPublished):
        yield Entry(event.t, full_name(namespace, "battery_state"), event.message, essential=True)


def scene_and_robot_of(transcript: Transcript) -> tuple[str, str]:
    """Return the scene and the kind of robot; "" and "" if the transcript has no postures."""
    described = (event for event in transcript.postures if isinstance(event, ev.BodyDescribed))
    return next(((event.scene, event.robot) for event in described), ("", ""))


def _postures(transcript: Transcript, namespace: str) -> Iterator[Entry]:
    body: ev.BodyDescribed | None = None
    for event in transcript.postures:
        if isinstance(event, ev.BodyDescribed):
            body = event
        elif body and len(event.base) == 7 and len(event.twist) == 6:
            for name, message in _messages(event, body):
                topic = name if name == TF else full_name(namespace, name)
                yield Entry(event.t, topic, message, essential=True)


def _messages(posture: ev.PostureTruth, body: ev.BodyDescribed) -> Iterator[tuple[str, Any]]:
    at = stamp(posture.t)
    odom = Header(stamp=at, frame_id="odom")
    odometry = Odometry(header=odom, child_frame_id="base_link")
    odometry.pose.pose = _pose(posture.base)
    _set_xyz(odometry.twist.twist.linear, posture.twist[:3])
    _set_xyz(odometry.twist.twist.angular, posture.twist[3:])
    yield "odom", odometry
    joints = Header(stamp=at)
    moving = {"position": posture.positions, "velocity": posture.velocities}
    yield "joint_states", JointState(header=joints, name=body.joints, **moving)
    objects = dict(zip(body.objects, posture.objects, strict=False))
    for name, place in objects.items():
        yield f"objects/{name}/pose", PoseStamped(header=odom, pose=_pose(place))
    yield TF, _transforms(odom, {"base_link": posture.base, **objects})


def _states(transcript: Transcript, topic: str) -> Iterator[Entry]:
    last: tuple[int, bool, int] | None = None
    for robot in transcript.ground_truth:
        state = robot.mode, robot.motors_enabled, robot.steps
        if state != last:
            last = state
            message = RobotState(
                header=Header(stamp=stamp(robot.t)),
                mode=robot.mode,
                motors_enabled=robot.motors_enabled,
                steps=robot.steps,
            )
            yield Entry(robot.t, topic, message, essential=True)


def _pose(place: Sequence[float]) -> Pose:
    pose = Pose()
    _set_xyz(pose.position, place[:3])
    _set_xyz(pose.orientation, place[3:6])
    pose.orientation.w = float(place[6])
    return pose


def _set_xyz(vector: Any, numbers: Sequence[float]) -> None:
    vector.x, vector.y, vector.z = map(float, numbers)


def _transforms(header: Header, poses: Mapping[str, Sequence[float]]) -> TFMessage:
    """Return the poses of frames in the header's frame: x, y, z (m) and a quaternion (x, y, z, w) for each."""
    message = TFMessage()
    for child, pose in poses.items():
        stamped = TransformStamped(header=header, child_frame_id=child)
        moved, turned = stamped.transform.translation, stamped.transform.rotation
        moved.x, moved.y, moved.z, turned.x, turned.y, turned.z, turned.w = map(float, pose)
        message.transforms.append(stamped)
    return message
