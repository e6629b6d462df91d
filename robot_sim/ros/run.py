"""Run the robot node in one thread: step, wait, publish, process commands."""

from __future__ import annotations

import gc
import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from robot_sim.humanoid import Humanoid
from robot_sim.ros.ground_truth import GROUND_TRUTH_RATE, GroundTruthWriter
from robot_sim.ros.node import HumanoidNode
from robot_sim.ros.pacing import Pacing
from robot_sim.ros.periodic_jobs import TOLERANCE, PeriodicJobs
from robot_sim.ros.scenario_control import ScenarioControl, apply_command
from robot_sim.ros.services import Services
from ros_runtime.record.ground_truth import RobotCommanded, RobotReady

if TYPE_CHECKING:  # arenas need neither of these modules
    from robot_sim.ros.sim_controls import SimControls
    from robot_sim.views.web_view import WebView

LONGEST_CYCLE = 0.02  # s of physics in a cycle; a cycle is shorter if a message is due
CATCH_UP_CYCLES = 6  # after at most this many cycles without a wait, commands are processed
PAUSE_PERIOD = 0.02  # s between two cycles while the simulation is paused
SERVICE_RATE = 20.0  # Hz, simulated, of answering requests
EXECUTOR_RATE = 1.0  # Hz, simulated, of spinning the executor, which takes forty times as long


def run(
    humanoid: Humanoid,
    node: HumanoidNode,
    pacing: Pacing,
    is_running: Callable[[], bool],
    *,
    ground_truth: GroundTruthWriter | None = None,
    control: ScenarioControl | None = None,
    controls: SimControls | None = None,
    view: WebView | None = None,
) -> None:
    """Drive the simulation until `is_running` returns False.

    Args:
        humanoid: the simulated robot.
        node: its ROS node.
        pacing: keeps simulated time in step with the system clock.
        is_running: called in every cycle; False ends the simulation.
        ground_truth: writes the ground truth at 50 Hz of simulated time.
        control: reads the commands of a scenario; only for a graded robot.
        controls: the services under /sim; only for a robot that is not graded.
        view: shows the robot in a browser.
    """
    services = Services(node)
    jobs = [(SERVICE_RATE, services.answer_requests), (EXECUTOR_RATE, services.spin_executor)]
    if ground_truth:
        jobs.insert(0, (GROUND_TRUTH_RATE, lambda: ground_truth.robot(humanoid, pacing.take_worst_lag())))
    chores = PeriodicJobs(*jobs)
    gc.freeze()  # otherwise each garbage collection would scan the present objects, which live until the end
    cycles_since_wait = 0
    if ground_truth:
        ground_truth.write(RobotReady(fastest=humanoid.body.limits.forward, still=humanoid.body.still_speed))
    pacing.restart(humanoid.time)
    while is_running():
        if control:
            for command in control.commands():
                pacing.lag(humanoid.time)  # record the lag, because restart() drops it
                apply_command(command, humanoid, node, ground_truth)
                pacing.restart(humanoid.time)
                if ground_truth:
                    ground_truth.write(RobotCommanded(command=command))
        if controls and controls.take_reset():
            apply_command({"do": "reset"}, humanoid, node)
            pacing.restart(humanoid.time)
        steps = _steps_until(min(node.next_due, chores.next_due), humanoid)
        if controls:
            steps = controls.steps_due(steps)
        if steps == 0:
            time.sleep(PAUSE_PERIOD)
            services.answer_requests()
            node.process_commands()
            continue
        for _ in range(steps):
            humanoid.step()
        wait = pacing.wall_time_until(humanoid.time)
        if wait > 0:
            time.sleep(wait)
        node.publish_due()
        chores.run(humanoid.time)
        if view:
            view.show()
        cycles_since_wait += 1
        if wait > 0 or cycles_since_wait >= CATCH_UP_CYCLES:
            cycles_since_wait = 0
            node.process_commands()
    node.report_refused()


def _steps_until(due: float, humanoid: Humanoid) -> int:
    """Return the number of timesteps until simulated time `due` (s), at most LONGEST_CYCLE."""
    seconds = min(due - humanoid.time, LONGEST_CYCLE)
    return max(1, math.ceil((seconds - TOLERANCE) / humanoid.timestep))
