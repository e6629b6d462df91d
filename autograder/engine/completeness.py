"""Requires a complete record of a run before every check: absence of evidence never passes."""

from __future__ import annotations

from itertools import pairwise

from autograder.authoring.checks import Scenario
from autograder.authoring.diagnosis.missing import held_up
from autograder.authoring.diagnosis.root_cause import why_the_robot_was_held_up
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.simulation_lag import MAX_LAG, lateness

MAX_REPORT_GAP = 1.5  # s on the arena's clock, between two reports of the simulator
COMMAND_TIMEOUT = 1.5  # s on the arena's clock until a command of the scenario takes effect


def require_whole(run: Transcript, scenario: Scenario) -> None:
    """Require that the scenario ran to its end, and that the simulator kept running and executed every command.

    Raises:
        Failure: the record is incomplete because of the submission.
        CannotBeJudged: the record is incomplete for another reason.
    """
    if run.first(ev.ScenarioEnded) is None:
        raise held_up(run, f"the record breaks off at {run.end:.1f} s")
    if scenario.robot is not None:
        _require_simulated_time(run)
        _require_effects(run)
        if lateness(run) > MAX_LAG and why_the_robot_was_held_up(run):
            raise held_up(run, f"the robot fell {lateness(run):.1f} s behind its time")


def _require_simulated_time(run: Transcript) -> None:
    """Require that the simulator reported without a long gap from the node's readiness to the end."""
    ready = run.first(ev.NodeReady)
    ended = run.first(ev.ScenarioEnded)
    start, end = ready.t if ready else 0.0, ended.t if ended else run.end
    times = [start, *(robot.t for robot in run.ground_truth if start < robot.t < end), end]
    silence, since = max((later - earlier, earlier) for earlier, later in pairwise(times))
    if not run.ground_truth or silence > MAX_REPORT_GAP:
        raise held_up(run, f"the simulation stood still for {silence:.1f} s from {since:.1f} s on")


def _require_effects(run: Transcript) -> None:
    """Require that each command of the scenario took effect, and within COMMAND_TIMEOUT unless the machine was slow."""
    effects = run.all(ev.RobotCommanded)
    for sent in run.all(ev.CommandSent):
        effect = next((effect for effect in effects if effect.command == sent.command), None)
        what = f"the robot did not obey the grader's command {sent.command.get('do', '')} at {sent.t:.1f} s"
        if effect is None:
            raise held_up(run, what)
        effects.remove(effect)
        if effect.t - sent.t > COMMAND_TIMEOUT and why_the_robot_was_held_up(run):
            raise held_up(run, f"{what} until {effect.t:.1f} s")
