"""Runs the humanoid under ROS 2 in this process, which may be a fork of a process that has built it."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING

import rclpy
from rclpy.signals import SignalHandlerOptions

from robot_sim.humanoid import Humanoid
from robot_sim.ros.ground_truth import GroundTruthWriter
from robot_sim.ros.node import HumanoidNode
from robot_sim.ros.options import RobotOptions, parse_options
from robot_sim.ros.pacing import Pacing
from robot_sim.ros.run import run
from robot_sim.ros.scenario_control import ScenarioControl

if TYPE_CHECKING:
    from robot_sim.views.web_view import WebView

__all__ = ["RobotOptions", "build_humanoid", "parse_options", "serve_robot"]

CROUCH = 0.45  # m, height of the pelvis
LONGEST_SETTLING = 10.0  # s, simulated; limit for simulating a robot that may rest until it rests


def build_humanoid(options: RobotOptions) -> Humanoid:
    """Build a humanoid for these options; one that may rest is simulated until it rests."""
    built = Humanoid(options.scene, seed=options.seed, robot=options.robot)
    built.may_rest = options.may_rest
    built.reset(height=CROUCH if options.crouch else None)
    while built.may_rest and not built.is_resting and built.time < LONGEST_SETTLING:
        built.step()
    return built


def serve_robot(options: RobotOptions, humanoid: Humanoid | None = None) -> None:
    """Run the robot until SIGINT or SIGTERM; call it in the main thread.

    Neither this process nor one from which it was forked may have initialized ROS before: the middleware's threads
    do not survive a fork.

    Args:
        options: how to run the robot.
        humanoid: the result of `build_humanoid` for these options; built here unless given.
    """
    signalled = False

    def stop(_signal, _frame) -> None:
        nonlocal signalled
        signalled = True

    def should_run() -> bool:
        return not signalled

    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)

    ground_truth = GroundTruthWriter(options.ground_truth_fd) if options.ground_truth_fd is not None else None
    humanoid = humanoid or build_humanoid(options)
    if ground_truth and options.postures:
        ground_truth.report_postures(humanoid)
    control = ScenarioControl(options.control_fd) if options.control_fd is not None else None
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = HumanoidNode(humanoid, options.namespace, ground_truth)
    node.battery_sensor_connected = not options.battery_sensor_unplugged
    node.joint_sensors_connected = not options.joint_sensors_unplugged
    node.robot_state_published = not options.robot_state_unpublished
    pacing = Pacing(options.rtf)
    controls = view = None
    if control is None:  # not a graded run, so /sim is offered
        from robot_sim.ros.sim_controls import SimControls

        controls = SimControls(node, humanoid, pacing)
        node.inboxes += controls.inboxes
        view = _open_view(humanoid, options.port) if options.view else None
        print(
            f"{humanoid.body.name} stands in {options.namespace} at {options.rtf:g} times real time; Ctrl-C ends it",
            flush=True,
        )
    try:
        run(
            humanoid,
            node,
            pacing,
            should_run,
            ground_truth=ground_truth,
            control=control,
            controls=controls,
            view=view,
        )
    finally:
        if view:
            view.close()
        node.destroy_node()
        rclpy.try_shutdown()


def _open_view(humanoid: Humanoid, port: int) -> WebView:
    from robot_sim.views.web_view import WebView

    try:
        view = WebView(humanoid, port)
    except (ImportError, OSError) as error:
        sys.exit(_view_error(error))
    print(f"view: {view.url}", flush=True)
    return view


def _view_error(error: ImportError | OSError) -> str:
    if isinstance(error, ImportError):
        return "course sim: the view needs MuJoCo 4, which needs Python 3.11 or newer"
    return f"course sim: the view could not be opened: {error}"
