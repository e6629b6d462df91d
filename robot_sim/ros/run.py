"""Runs the robot node: step, wait, publish, hear, in one thread."""

from __future__ import annotations

import gc
import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from robot_sim.humanoid import Humanoid
from robot_sim.ros.node import HumanoidNode
from robot_sim.ros.pacing import Pacing
from robot_sim.ros.periodic_jobs import TOLERANCE, PeriodicJobs
from robot_sim.ros.scenario_control import ScenarioControl, obey
from robot_sim.ros.services import Services
from robot_sim.ros.truth import TRUTH_RATE, TruthWriter

if TYPE_CHECKING:  # no arena needs them
    from robot_sim.ros.sim_controls import SimControls
    from robot_sim.views.web_view import WebView

LONGEST_CYCLE = (
    0.02  # s of physics between two looks at the commands, unless something is to be published before
)
CATCH_UP_CYCLES = 6  # after this many cycles without a wait, commands are heard all the same
PAUSE_PERIOD = 0.02  # s between two looks while the simulation stands still
SERVICE_RATE = 20.0  # Hz, simulated: looks at the node's services
REST_RATE = 1.0  # Hz, simulated: looks at whatever else the middleware tells, which cost forty times as much


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
    services = Services(node)
    jobs = [(SERVICE_RATE, services.look), (REST_RATE, services.look_at_the_rest)]
    if truth:
        jobs.insert(0, (TRUTH_RATE, lambda: truth.robot(humanoid, pacing.take_worst_lag())))
    chores = PeriodicJobs(*jobs)
    gc.freeze()  # what exists by now stays; looking through it again and again costs milliseconds each time
    cycles_since_wait = 0
    if truth:
        truth.ready()
    pacing.restart(humanoid.time)
    while is_running():
        if control:
            for command in control.commands():
                pacing.lag(humanoid.time)  # noted before it is let go of
                obey(command, humanoid, node, truth)
                pacing.restart(humanoid.time)
                if truth:
                    truth.commanded(command)
        if controls and controls.take_reset():
            obey({"do": "reset"}, humanoid, node)
            pacing.restart(humanoid.time)
        steps = _steps_until(min(node.next_due, chores.next_due), humanoid)
        if controls:
            steps = controls.steps_due(steps)
        if steps == 0:
            time.sleep(PAUSE_PERIOD)
            services.look()
            node.hear()
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
            node.hear()
    node.tell_refused()


def _steps_until(due: float, humanoid: Humanoid) -> int:
    """How many steps to make before something is due, at simulated time ``due`` (s), or commands are to be heard."""
    seconds = min(due - humanoid.time, LONGEST_CYCLE)
    return max(1, math.ceil((seconds - TOLERANCE) / humanoid.timestep))
