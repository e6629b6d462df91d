"""A trusted node in the arena and a student's node in its sandbox discover each other and communicate."""

from __future__ import annotations

from pathlib import Path

import pytest
from arenas import Student, run_student

import ros_runtime
from autograder.isolation.arena_process import Kind
from ros_runtime.environment import ros_environment

pytest.importorskip("rclpy")

_NODE = """
import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("student")
answers = node.create_publisher(String, "answers", 10)
node.create_subscription(String, "questions", lambda m: answers.publish(String(data=m.data.upper())), 10)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    print("shut down cleanly")
"""
_OBSERVER = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("observer")
received = []
node.create_subscription(String, "answers", received.append, 10)
questions = node.create_publisher(String, "questions", 10)
node.create_timer(0.05, lambda: questions.publish(String(data="hello")))
deadline = time.monotonic() + 20
while not received and student.returncode is None and time.monotonic() < deadline:
    rclpy.spin_once(node, timeout_sec=0.1)
assert received and received[0].data == "HELLO", student.stderr.text
student.interrupt()
"""


def test_a_node_in_the_sandbox_answers_a_node_in_the_arena(kind: Kind) -> None:
    env, paths = ros_environment(), [str(Path(ros_runtime.__file__).parent)]
    run = run_student(Student(_NODE, _OBSERVER, env=env, arena_env=env, paths=paths), kind)
    assert run.stdout == "shut down cleanly\n"
    assert run.returncode == 0
