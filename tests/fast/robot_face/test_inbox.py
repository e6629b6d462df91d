"""Which messages the robot accepts, tested with bytes and without another node."""

import struct
from types import SimpleNamespace

import pytest
from geometry_msgs.msg import Twist
from rclpy.serialization import serialize_message
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from autograder.authoring.evidence.events import RobotRefused, parse_event
from robot_sim.arms.joint_trajectory import MOVABLE
from robot_sim.ros.ground_truth import GroundTruthWriter
from robot_sim.ros.inbox import BYTES_A_SECOND, FLOOD, MESSAGES_A_SECOND, Inbox
from robot_sim.ros.trajectory_size import MOST_BYTES, MOST_POINTS, count_joints_and_points, why_too_large


class Topic:
    """A subscription whose messages a test sets, and the messages and reports that result."""

    def __init__(self, kind, **limits):
        self.waiting, self.received, self.reports = [], [], []
        subscription = SimpleNamespace(
            topic_name="/robot/topic", msg_type=kind, callback=self.received.append, handle=self
        )
        self.inbox = Inbox(subscription, self.report, **limits)

    def report(self, refused):
        self.reports.append((refused.topic, refused.count, refused.bytes, refused.limit, refused.reason))

    def take_message(self, kind, raw):
        assert raw, "the inbox must request bytes"
        return (self.waiting.pop(0), None) if self.waiting else None


def trajectory(points, joints=MOVABLE, full=False):
    values = [0.1] * len(joints)
    more = {"velocities": values, "accelerations": values, "effort": values} if full else {}
    point = JointTrajectoryPoint(positions=values, **more)
    return serialize_message(JointTrajectory(joint_names=list(joints), points=[point] * points))


def trajectories():
    return Topic(JointTrajectory, most_bytes=MOST_BYTES, why_not=why_too_large)


def test_a_valid_message_reaches_the_callback():
    topic = Topic(Twist)
    command = Twist()
    command.linear.x = 0.2
    topic.inbox.process(serialize_message(command))
    assert topic.received == [command]
    topic.inbox.report()
    assert topic.reports == []


@pytest.mark.parametrize("size", [0, 1, 4, 20, 51])
def test_a_message_that_ends_too_soon_is_refused(size):
    topic = Topic(Twist)
    topic.inbox.process(serialize_message(Twist())[:size])
    topic.inbox.report()
    assert topic.received == []
    assert topic.reports == [("/robot/topic", 1, size, 64, "malformed")]


def test_a_message_of_fixed_length_that_is_longer_is_refused():
    topic = Topic(Twist)
    topic.inbox.process(serialize_message(Twist()) + bytes(1000))
    topic.inbox.report()
    assert topic.received == []
    assert topic.reports == [("/robot/topic", 1, 1052, 64, "more than 64 bytes")]


@pytest.mark.parametrize("points", [0, 1, MOST_POINTS])
def test_every_trajectory_within_the_limit_of_points_reaches_the_callback(points):
    topic = trajectories()
    topic.inbox.process(trajectory(points, full=True))
    assert [len(message.points) for message in topic.received] == [points]


def test_a_trajectory_with_more_points_is_refused_however_short_they_are():
    topic = trajectories()
    topic.inbox.process(trajectory(MOST_POINTS + 1, joints=()))
    topic.inbox.process(trajectory(30_000))
    topic.inbox.report()
    assert topic.received == []
    assert [(count, reason) for _, count, *_, reason in topic.reports] == [
        (1, "more than 500 points"),
        (1, f"more than {MOST_BYTES} bytes"),
    ]


def test_a_trajectory_with_thousands_of_joints_is_refused():
    topic = trajectories()
    topic.inbox.process(trajectory(0, joints=[""] * 20_000))
    topic.inbox.report()
    assert topic.received == []
    assert topic.reports[0][-1] == "more than 64 joints"


def test_lengths_are_read_from_bytes():
    message = JointTrajectory(joint_names=["a", "four", "", "fivef"], points=[JointTrajectoryPoint()] * 3)
    message.header.frame_id = "odom"
    data = serialize_message(message)
    assert count_joints_and_points(data) == (4, 3)
    for size in range(72):
        with pytest.raises(ValueError, match="too soon"):
            count_joints_and_points(data[:size])
    with pytest.raises(ValueError, match="too soon"):
        count_joints_and_points(data[:12] + struct.pack("<I", 0xFFFFFFFF) + data[16:])


def test_a_flood_is_limited_to_a_rate_and_the_newest_messages_wait():
    topic = Topic(Twist)
    for tick in range(100):  # 2 s in looks of 20 ms
        topic.waiting += [serialize_message(Twist())] * 30
        topic.waiting = topic.waiting[-10:]  # as a history of depth 10 keeps them
        topic.inbox.process_arrived(0.02 * tick)
    assert len(topic.received) == pytest.approx(3 * MESSAGES_A_SECOND, abs=5)  # 1 s worth at first, then 2 s
    topic.inbox.report()
    assert topic.reports[-1][1] > 50
    assert {reason for *_, reason in topic.reports} == {FLOOD}
    assert len(topic.reports) < 12, "a few reports a second"


def test_a_fast_publisher_does_not_count_as_a_flood():
    topic = Topic(Twist)
    for tick in range(500):
        topic.waiting += [serialize_message(Twist())] * 2  # 100 Hz
        topic.inbox.process_arrived(0.02 * tick)
    assert len(topic.received) == 1000
    assert topic.reports == []


def test_too_large_messages_are_taken_at_a_limited_rate():
    topic, giant = trajectories(), bytes(5_000_000)
    for tick in range(500):  # 10 s
        topic.waiting = [giant] * 10
        topic.inbox.process_arrived(0.02 * tick)
    topic.inbox.report()
    taken = topic.reports[-1][1]
    assert 10 * 1.0 <= taken <= 10 * 5_000_000 / BYTES_A_SECOND
    assert taken <= 12
    topic.waiting = [trajectory(5)]
    topic.inbox.process_arrived(12.0)
    assert len(topic.received) == 1, "a sound one is received after it"


def test_messages_are_processed_after_time_has_gone_back():
    topic = Topic(Twist)
    topic.inbox.process_arrived(100.0)
    topic.waiting = [serialize_message(Twist())]
    topic.inbox.process_arrived(0.0)
    assert len(topic.received) == 1


def test_a_refused_message_is_written_to_the_ground_truth(tmp_path):
    with open(tmp_path / "truth", "w+b") as file:
        inbox = Topic(Twist).inbox
        inbox._report = GroundTruthWriter(file.fileno()).write
        inbox.process(b"short")
        inbox.report()
        file.seek(0)
        event = parse_event(file.readline())
    assert isinstance(event, RobotRefused)
    assert event == RobotRefused(
        t=event.t, topic="/robot/topic", count=1, bytes=5, limit=64, reason="malformed"
    )
