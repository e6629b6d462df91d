"""A resting robot, whose physics is not integrated, publishes the same messages as an integrated robot."""

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped, Twist, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.qos import qos_profile_sensor_data
from robot_process import LATCHED, running_robot
from sensor_msgs.msg import BatteryState, Imu, JointState

from humanoid_interfaces.msg import RobotState

REAL_TIME_FACTOR = 2.5  # at which a busy machine keeps up
TOPICS = {  # message type, QoS, number of messages to receive, rate in Hz of simulated time
    "odom": (Odometry, qos_profile_sensor_data, 100, 20.0),
    "joint_states": (JointState, qos_profile_sensor_data, 100, 20.0),
    "imu": (Imu, qos_profile_sensor_data, 250, 50.0),
    "l_hand/pose": (PoseStamped, qos_profile_sensor_data, 100, 20.0),
    "r_foot/wrench": (WrenchStamped, qos_profile_sensor_data, 250, 50.0),
    "battery_state": (BatteryState, LATCHED, 10, 2.0),
    "robot_state": (RobotState, LATCHED, 25, 5.0),
}


@pytest.fixture(scope="module")
def robots():
    """A robot that may rest, and one that is integrated; both have stood long enough to be still."""
    options = ("--rtf", str(REAL_TIME_FACTOR))
    with running_robot(*options, "--may-rest") as resting, running_robot(*options) as integrated:
        for robot in (resting, integrated):
            robot.collect(Odometry, "odom", 200)  # 10 s
        yield resting, integrated


@pytest.fixture(scope="module")
def received(robots):
    """The messages of each topic: a list from the resting robot, and a list from the integrated one."""
    return {
        topic: [robot.collect(kind, topic, count, qos) for robot in robots]
        for topic, (kind, qos, count, _) in TOPICS.items()
    }


def vectors(messages, *names):
    """The numbers of fields such as "pose.pose.position", one row per message."""

    def numbers(message, name):
        for part in name.split("."):
            message = getattr(message, part)
        if hasattr(message, "get_fields_and_field_types"):
            return [getattr(message, field) for field in message.get_fields_and_field_types()]
        return np.atleast_1d(message)

    return np.array([np.concatenate([numbers(message, name) for name in names]) for message in messages])


def test_the_resting_robot_has_the_same_topics_types_and_qos(robots):
    def offered(robot):
        return {
            (topic, kind, info.qos_profile.reliability, info.qos_profile.durability)
            for topic, kinds in robot.node.get_topic_names_and_types()
            for kind in kinds
            for info in robot.node.get_publishers_info_by_topic(topic)
            if info.node_name == "humanoid"
        }

    resting, integrated = map(offered, robots)
    assert resting == integrated
    assert len(resting) >= len(TOPICS)


@pytest.mark.parametrize("topic", TOPICS)
def test_the_resting_robot_publishes_at_the_same_rate_with_regular_stamps(received, topic):
    rate = TOPICS[topic][3]
    for messages in received[topic]:
        stamps = [message.header.stamp.sec + message.header.stamp.nanosec * 1e-9 for message in messages]
        intervals = np.diff(stamps[1:])  # without the first message, which may be an older, latched one
        assert intervals.mean() == pytest.approx(1 / rate / REAL_TIME_FACTOR, rel=0.3)


def test_the_resting_robot_has_the_same_pose_and_joint_states(received):
    fields = ("pose.pose.position", "pose.pose.orientation", "twist.twist.linear", "twist.twist.angular")
    resting, integrated = (vectors(messages, *fields) for messages in received["odom"])
    assert resting == pytest.approx(integrated, abs=1e-5)
    resting, integrated = (vectors(messages, "position", "velocity") for messages in received["joint_states"])
    assert resting == pytest.approx(integrated, abs=1e-5)
    resting, integrated = (vectors(messages, "effort") for messages in received["joint_states"])
    assert resting == pytest.approx(integrated, abs=1e-2)


def test_the_resting_robot_has_the_same_hand_poses_and_foot_loads(received):
    resting, integrated = (
        vectors(messages, "pose.position", "pose.orientation") for messages in received["l_hand/pose"]
    )
    assert resting == pytest.approx(integrated, abs=1e-5)
    resting, integrated = (
        vectors(messages, "wrench.force", "wrench.torque") for messages in received["r_foot/wrench"]
    )
    assert resting == pytest.approx(integrated, abs=0.05)


def test_the_resting_robots_imu_has_the_same_noise(received):
    for field, least in (("angular_velocity", 1e-4), ("linear_acceleration", 1e-3)):
        resting, integrated = (vectors(messages, field) for messages in received["imu"])
        assert (resting.std(axis=0) > least).all()
        assert resting.std(axis=0) == pytest.approx(integrated.std(axis=0), rel=0.5)
        assert resting.mean(axis=0) == pytest.approx(
            integrated.mean(axis=0), abs=float(integrated.std(axis=0).max())
        )
        assert len(np.unique(resting, axis=0)) == len(resting)  # each reading has new noise


def test_the_resting_robots_battery_drains_at_the_same_rate(received):
    def rate(messages):
        """The change from one message to the next; the median, because a busy machine may lose one."""
        return np.median(np.diff(vectors(messages, "percentage")[:, 0]))

    resting, integrated = received["battery_state"]
    assert rate(resting) < 0
    assert rate(resting) == pytest.approx(rate(integrated), rel=0.05)
    fields = ("voltage", "current")
    assert vectors(resting, *fields) == pytest.approx(vectors(integrated, *fields), rel=1e-3)


def test_the_resting_robot_publishes_the_same_robot_state(received):
    resting, integrated = (
        vectors(messages, "mode", "motors_enabled", "steps") for messages in received["robot_state"]
    )
    assert (resting == integrated).all()


def test_the_resting_robot_walks_at_a_command(robots):
    command = Twist()
    command.linear.x = 0.2
    for robot in robots:
        publisher = robot.node.create_publisher(Twist, "cmd_vel", 10)
        timer = robot.node.create_timer(0.02, lambda publisher=publisher: publisher.publish(command))
        robot.one(RobotState, "robot_state", LATCHED, until=lambda state: state.mode == RobotState.WALKING)
        robot.node.destroy_timer(timer)
        robot.one(RobotState, "robot_state", LATCHED, until=lambda state: state.mode == RobotState.STANDING)
