"""Runs the robot node: step, publish, wait, hear, in one thread."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from rclpy.executors import SingleThreadedExecutor

from robot_sim.humanoid import Humanoid
from robot_sim.node import HumanoidNode
from robot_sim.pacing import Pacing
from robot_sim.scenario_control import ScenarioControl, obey
from robot_sim.schedule import Schedule
from robot_sim.truth import TRUTH_RATE, TruthWriter

if TYPE_CHECKING:  # no arena needs them
    from robot_sim.sim_controls import SimControls
    from robot_sim.web_view import WebView

STEPS_PER_CYCLE = 2  # 10 ms of physics between two looks at the commands
CATCH_UP_CYCLES = 10  # after this many cycles without a wait, commands are heard all the same
PAUSE_PERIOD = 0.02  # s between two looks while the simulation stands still
SERVICE_RATE = 20.0  # Hz, simulated: looks at the node's services, which cost fifty times one at its commands


def run(
    humanoid: Humanoid,
    node: HumanoidNode,
    pacing: Pacing,
    is_running: Callable[[], bool],
    *,
    truth: TruthWriter | None = None,
    control: ScenarioControl | None = None,
    controls: SimControls | None = None,
    view: WebView | None = None,
) -> None:
    """Drive the simulation until `is_running` says no.

    Truth is written at 50 Hz of simulated time; `control` is the scenario's hand on a graded robot, `controls` are
    everybody's on one that is not, and `view` shows it.
    """
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    services = Schedule((SERVICE_RATE, lambda: executor.spin_once(timeout_sec=0)))
    lag = 0.0
    reports = Schedule((TRUTH_RATE, lambda: truth.robot(humanoid, lag))) if truth else None
    cycles_since_wait = 0
    if truth:
        truth.ready()
    pacing.restart(humanoid.time)
    while is_running():
        if control:
            for command in control.commands():
                obey(command, humanoid, node, truth)
                pacing.restart(humanoid.time)
                if truth:
                    truth.commanded(command)
        if controls and controls.take_reset():
            obey({"do": "reset"}, humanoid, node)
            pacing.restart(humanoid.time)
        steps = controls.steps_due(STEPS_PER_CYCLE) if controls else STEPS_PER_CYCLE
        if steps == 0:
            executor.spin_once(timeout_sec=PAUSE_PERIOD)
            node.hear()
            continue
        for _ in range(steps):
            humanoid.step()
        node.publish_due()
        lag = max(0.0, pacing.lag(humanoid.time))
        if reports:
            reports.run(humanoid.time)
        services.run(humanoid.time)
        if view:
            view.show()
        cycles_since_wait += 1
        wait = pacing.wall_time_until(humanoid.time)
        if wait > 0 or cycles_since_wait >= CATCH_UP_CYCLES:
            cycles_since_wait = 0
            _serve(node, pacing, humanoid)


def _serve(node: HumanoidNode, pacing: Pacing, humanoid: Humanoid) -> None:
    """Wait until the next cycle is due, then hear the commands that came meanwhile."""
    time.sleep(pacing.wall_time_until(humanoid.time))
    node.hear()
