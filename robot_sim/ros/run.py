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

if TYPE_CHECKING:  # no arena needs them
    from robot_sim.ros.sim_controls import SimControls
    from robot_sim.views.web_view import WebView

LONGEST_CYCLE = 0.02  # s of physics between two looks at the commands, or less if a message is due
CATCH_UP_CYCLES = 6  # commands are processed at the latest after this many cycles without a wait
PAUSE_PERIOD = 0.02  # s between two looks at the commands while the simulation stands still
SERVICE_RATE = 20.0  # Hz, simulated: answers to requests
REST_RATE = 1.0  # Hz, simulated: turns of the executor, which cost forty times as much


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
        is_running: called in every cycle.
        ground_truth: writes the ground truth at 50 Hz of simulated time.
        control: reads the commands of a scenario; only for a graded robot.
        controls: the services under /sim; only for a robot that is not graded.
        view: shows the robot in a browser.
    """
    services = Services(node)
    jobs = [(SERVICE_RATE, services.answer_requests), (REST_RATE, services.spin_executor)]
    if ground_truth:
        jobs.insert(0, (GROUND_TRUTH_RATE, lambda: ground_truth.robot(humanoid, pacing.take_worst_lag())))
    chores = PeriodicJobs(*jobs)
    gc.freeze()  # present objects live until the end; without freeze each collection would scan them for milliseconds
    cycles_since_wait = 0
    if ground_truth:
        ground_truth.ready()
    pacing.restart(humanoid.time)
    while is_running():
        if control:
            for command in control.commands():
                pacing.lag(humanoid.time)  # noted before it is dropped
                apply_command(command, humanoid, node, ground_truth)
                pacing.restart(humanoid.time)
                if ground_truth:
                    ground_truth.commanded(command)
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
    """Return how many steps to make until simulated time `due` (s), or until commands are to be processed."""
    seconds = min(due - humanoid.time, LONGEST_CYCLE)
    return max(1, math.ceil((seconds - TOLERANCE) / humanoid.timestep))
