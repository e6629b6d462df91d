"""`python -m robot_sim`: the robot node alone."""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

import rclpy
from rclpy.signals import SignalHandlerOptions

from robot_sim.humanoid import Humanoid
from robot_sim.node import HumanoidNode
from robot_sim.pacing import Pacing
from robot_sim.run import run
from robot_sim.scenario_control import ScenarioControl
from robot_sim.scenes import SCENES
from robot_sim.truth import TruthWriter

if TYPE_CHECKING:
    from robot_sim.web_view import WebView

CROUCH = 0.45  # m, height of the pelvis


def main() -> None:
    """Run the robot until SIGINT or SIGTERM."""
    arguments = _parser().parse_args()
    running = True

    def stop(_signal, _frame) -> None:
        nonlocal running
        running = False

    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)

    if arguments.robot:
        return _show_other_robot(arguments.robot, arguments.port, lambda: running)
    truth = TruthWriter(arguments.truth_fd) if arguments.truth_fd is not None else None
    control = ScenarioControl(arguments.control_fd) if arguments.control_fd is not None else None
    humanoid = Humanoid(arguments.scene, seed=arguments.seed)
    if arguments.crouch:
        humanoid.reset(height=CROUCH)
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = HumanoidNode(humanoid, arguments.namespace, truth)
    node.battery_sensor_connected = not arguments.battery_sensor_unplugged
    node.joint_sensors_connected = not arguments.joint_sensors_unplugged
    node.robot_state_published = not arguments.robot_state_unpublished
    pacing = Pacing(arguments.rtf)
    controls = view = None
    if control is None:  # nobody is graded
        from robot_sim.sim_controls import SimControls

        controls = SimControls(node, humanoid, pacing)
        node.heard += controls.heard
        view = _open_view(humanoid, arguments.port) if arguments.view else None
        print(
            f"humanoid stands in {arguments.namespace} at {arguments.rtf:g} times real time; Ctrl-C ends it",
            flush=True,
        )
    try:
        run(
            humanoid,
            node,
            pacing,
            lambda: running,
            truth=truth,
            control=control,
            controls=controls,
            view=view,
        )
    finally:
        if view:
            view.close()
        node.destroy_node()
        rclpy.try_shutdown()


def _show_other_robot(name: str, port: int, is_running: Callable[[], bool]) -> None:
    from robot_sim.other_robots import RobotUnavailable, show

    try:
        show(name, port, is_running)
    except RobotUnavailable as error:
        sys.exit(f"course sim: {error}")
    except (ImportError, OSError) as error:
        sys.exit(_why_there_is_no_view(error))


def _open_view(humanoid: Humanoid, port: int) -> WebView:
    from robot_sim.web_view import WebView

    try:
        view = WebView(humanoid, port)
    except (ImportError, OSError) as error:
        sys.exit(_why_there_is_no_view(error))
    print(f"view: {view.url}", flush=True)
    return view


def _why_there_is_no_view(error: ImportError | OSError) -> str:
    if isinstance(error, ImportError):
        return "course sim: the view needs MuJoCo 4, which needs Python 3.11 or newer"
    return f"course sim: the view could not be opened: {error}"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="course sim", description="Run the humanoid under ROS 2.")
    parser.add_argument(
        "--rtf",
        type=_factor,
        default=1.0,
        help="simulated seconds per second; 0: as fast as it can (default 1)",
    )
    parser.add_argument("--namespace", default="/robot", help="ROS namespace (default /robot)")
    parser.add_argument("--view", action="store_true", help="show the robot in a browser on this machine")
    parser.add_argument(
        "--port", type=int, default=0, help="of the view (default: the first free from 8080 on)"
    )
    parser.add_argument(
        "--robot",
        metavar="NAME",
        help="look at a real robot instead, such as unitree_g1: it stands in the browser view and has no ROS side",
    )
    parser.add_argument("--scene", choices=tuple(SCENES), default="flat")
    parser.add_argument("--crouch", action="store_true", help="begin in a crouch instead of standing")
    parser.add_argument("--seed", type=int, default=0, help="seed of the sensors' noise (default 0)")
    parser.add_argument("--truth-fd", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--control-fd", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--battery-sensor-unplugged", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--joint-sensors-unplugged", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--robot-state-unpublished", action="store_true", help=argparse.SUPPRESS)
    return parser


def _factor(text: str) -> float:
    value = float(text)
    if not 0 <= value <= 100:
        raise argparse.ArgumentTypeError(f"must lie between 0 and 100, got {text}")
    return value


if __name__ == "__main__":
    main()
