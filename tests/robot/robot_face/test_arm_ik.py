"""The service compute_arm_ik, called by another node, and the action server in docs/robot.md that calls it."""

from __future__ import annotations

import math
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import rclpy
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from robot_process import NAMESPACE, TIMEOUT, running_robot
from std_msgs.msg import Header
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from humanoid_interfaces.action import PickAndPlace
from humanoid_interfaces.srv import ComputeArmIK
from ros_runtime.environment import ros_environment

CODES = ComputeArmIK.Response
ANY = Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)
DOCS = Path(__file__).resolve().parents[3] / "docs/robot.md"


@pytest.fixture(scope="module")
def robot():
    with running_robot() as listener:
        yield listener


def pose(x, y, z, orientation=ANY, frame="odom"):
    return PoseStamped(
        header=Header(frame_id=frame),
        pose=Pose(position=Point(x=x, y=y, z=z), orientation=orientation),
    )


def solve(robot, hand_pose, arm="r", with_waist=False):
    request = ComputeArmIK.Request(arm=arm, hand_pose=hand_pose, with_waist=with_waist)
    return robot.call(ComputeArmIK, "compute_arm_ik", request)


@pytest.mark.parametrize("with_waist", [False, True])
def test_the_hand_reaches_the_requested_pose(robot, with_waist):
    x, y, z = wanted = (0.32, -0.2 if with_waist else -0.28, 0.9)
    answer = solve(robot, pose(*wanted, Quaternion(w=1.0)), with_waist=with_waist)
    assert answer.error_code == CODES.SUCCESS, answer.message
    assert answer.joint_state.name[:2] == (
        ["waist_yaw", "r_shoulder_pitch"] if with_waist else ["r_shoulder_pitch", "r_shoulder_roll"]
    )
    point = JointTrajectoryPoint(
        positions=answer.joint_state.position,
        velocities=[0.0] * len(answer.joint_state.name),
        time_from_start=Duration(sec=2),
    )
    robot.publish(JointTrajectory(joint_names=answer.joint_state.name, points=[point]), "joint_trajectory")

    def is_there(hand):
        position, orientation = hand.pose.position, hand.pose.orientation
        return (
            math.dist((position.x, position.y, position.z), (x, y, z)) < 0.006 and abs(orientation.w) > 0.999
        )

    robot.one(PoseStamped, "r_hand/pose", until=is_there)


def test_a_pose_is_interpreted_in_its_frame(robot):
    below = robot.call(
        ComputeArmIK, "compute_arm_ik", ComputeArmIK.Request(arm="l", hand_pose=pose(0.2, 0.3, 0.1))
    )
    assert below.error_code == CODES.NO_IK_SOLUTION, "0.1 m above the floor"
    above = solve(robot, pose(0.2, 0.3, 0.1, frame="base_link"), arm="l")
    assert above.error_code == CODES.SUCCESS, above.message


@pytest.mark.parametrize(
    ("hand_pose", "arm", "code", "message"),
    [
        (
            pose(0.3, 0.2, 0.9),
            "left",
            CODES.INVALID_GROUP_NAME,
            "arm 'left' is not known; expected 'l' or 'r'",
        ),
        (
            pose(0.3, 0.2, 0.9, frame="map"),
            "l",
            CODES.FRAME_TRANSFORM_FAILURE,
            "frame 'map'; expected odom or base",
        ),
        (pose(0.3, 0.2, 0.9, frame=""), "l", CODES.FRAME_TRANSFORM_FAILURE, "frame ''"),
        (pose(3.0, 0.2, 0.9), "l", CODES.NO_IK_SOLUTION, "out of reach: the arm is .* m too short"),
        (pose(0.0, 0.0, 0.9), "l", CODES.NO_IK_SOLUTION, "inside the robot's own body"),
        (pose(math.nan, 0.2, 0.9), "l", CODES.NO_IK_SOLUTION, "expected three finite numbers"),
        (
            pose(0.3, 0.2, 0.9, Quaternion(z=1.0, w=1.0)),
            "l",
            CODES.NO_IK_SOLUTION,
            "length 1.41; expected 1, or four",
        ),
        (pose(0.3, 0.2, 0.9, Quaternion(z=math.nan)), "l", CODES.NO_IK_SOLUTION, "length nan"),
    ],
)
def test_an_unsolvable_request_has_an_error_code_and_a_reason(robot, hand_pose, arm, code, message):
    answer = solve(robot, hand_pose, arm=arm)
    assert answer.error_code == code
    assert re.search(message, answer.message), answer.message
    assert list(answer.joint_state.name) == []


@pytest.fixture(params=["rclpy.spin(node)", "rclpy.spin(node, rclpy.executors.MultiThreadedExecutor())"])
def place_checker(robot, tmp_path, request):
    """The program of docs/robot.md, in two executors."""
    program = tmp_path / "place_checker.py"
    text = re.search(r"```python\n(.+?)```", DOCS.read_text(), re.DOTALL)[1]
    program.write_text(text.replace("rclpy.spin(node)", request.param))
    domain = str(robot.node.context.get_domain_id())
    process = subprocess.Popen(
        [sys.executable, program, "--ros-args", "-r", f"__ns:={NAMESPACE}"],
        env={**os.environ, **ros_environment(), "ROS_DOMAIN_ID": domain},
    )
    yield process
    process.send_signal(signal.SIGINT)
    assert process.wait(TIMEOUT) == 0


@pytest.fixture
def client_of_check_place(robot):
    """A client, and a function that waits for its futures in the test's own thread.

    A goal that is sent from one thread while another receives may lose its response in rclpy.
    """
    context = robot.node.context
    node = rclpy.create_node("asker", namespace=NAMESPACE, context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)

    def wait(future):
        executor.spin_until_future_complete(future, TIMEOUT)
        assert future.done(), f"no answer within {TIMEOUT:.0f} s"
        return future.result()

    client = ActionClient(node, PickAndPlace, "check_place")
    assert client.wait_for_server(TIMEOUT)
    yield client, wait
    executor.shutdown()
    node.destroy_node()


def test_an_action_can_call_the_service_while_it_executes(place_checker, client_of_check_place):
    client, wait = client_of_check_place

    def outcome(place):
        goal = wait(client.send_goal_async(PickAndPlace.Goal(object_id="cup", place_pose=place)))
        answer = wait(goal.get_result_async())
        return answer.status, answer.result

    deadline = time.monotonic() + TIMEOUT
    status, result = outcome(pose(0.32, -0.2, 0.9))
    while "not there yet" in result.error_msg and time.monotonic() < deadline:
        status, result = outcome(pose(0.32, -0.2, 0.9))
    assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, PickAndPlace.Result.NONE)
    status, result = outcome(pose(2.0, 0.0, 0.9))
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, PickAndPlace.Result.UNREACHABLE)
    assert "too short" in result.error_msg
