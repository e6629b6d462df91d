"""The API of the notebooks: start the robot, run a file as a node, call a service, send a goal, draw what happened.

    import lab
    lab.start_robot()
    server = lab.run_node("battery_service.py")
    lab.call("get_battery_status", GetBatteryStatus)

Every function that waits has a timeout, and its error says what was seen. Import `lab` before any ROS message type:
it turns on rclpy's checks of field types by an environment variable that rclpy reads when it is first imported.
"""
# ruff: noqa: E402, F401

import os
from contextlib import ExitStack

os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1"

from lab import notices, tracebacks
from ros_runtime.cell_notice import notice

_loading = ExitStack()
_loading.enter_context(notice("The lab is loading, which takes seconds, on a busy machine up to 20 s."))

from lab.client.commands import publish, walking
from lab.client.connection import node
from lab.client.exchange import wait_until
from lab.client.formatting import describe
from lab.client.goals import Goal, send_goal
from lab.client.graph import list_graph, nodes_in_graph
from lab.client.outcomes import CancelAnswer, Outcome
from lab.client.services import call, service_is_ready
from lab.client.topics import Pose, battery, mode, odometry, pose, robot_state
from lab.errors import LabError, NoAnswerError, NodeEndedError, NoRobotError, NoServerError, NotInTimeError
from lab.learning.design import check_design, draw_design
from lab.learning.gap import GapError
from lab.learning.pattern_choice import PatternChoice, choose_pattern
from lab.learning.prediction import Prediction, predict
from lab.learning.progress_table import show_progress
from lab.learning.quiz import Quiz, quiz
from lab.pictures.diagram import draw_sequence
from lab.pictures.film_beside import film_beside
from lab.pictures.film_from_above import film_from_above
from lab.pictures.gates import draw_gates
from lab.pictures.goal_states import draw_goal_states
from lab.pictures.graph_drawing import draw_graph
from lab.pictures.live_view import stop_watching, watch_robot
from lab.pictures.picture import show_robot
from lab.pictures.plots import plot_curves, plot_means
from lab.pictures.recording import Recording, record_robot
from lab.pictures.slider import slide
from lab.pictures.thread_plot import draw_threads
from lab.pictures.timeline import draw_timeline
from lab.running.interfaces import build_interfaces, export_package
from lab.running.programs import Program, run_program, start_program
from lab.running.programs_folder import keep_programs_in
from lab.running.robot import restart_robot, start_robot, stop_robot
from lab.running.session import stop_everything
from lab.running.student_nodes import StudentNode, run_node, stop_nodes

_loading.close()

__all__ = [name for name, each in globals().items() if getattr(each, "__module__", "").startswith("lab.")]
