"""Crouching and standing up in phases, each of which ends by a measurement."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from bench.robot.height_change import HeightChange
from bench.robot.trial import simulate
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.state import Mode

CROUCH, STANCE = 0.45, 0.60  # m
FASTEST = 0.15  # m/s
LONGEST = 15.0  # s


@pytest.fixture
def humanoid() -> TrialHumanoid:
    robot = TrialHumanoid()
    simulate(robot, 0.5)
    return robot


def height(humanoid: TrialHumanoid) -> float:
    return float(humanoid.base_pose().position[2])


def phases_of(humanoid: TrialHumanoid, change: HeightChange) -> list[str]:
    """Step until a change has ended; its phases in order."""
    seen = [change.phase.value]
    end = humanoid.time + LONGEST
    while not change.phase.is_last and humanoid.time < end:
        humanoid.step()
        if change.phase.value != seen[-1]:
            seen.append(change.phase.value)
    return seen


def until_phase(humanoid: TrialHumanoid, change: HeightChange, phase: str) -> None:
    assert simulate(humanoid, LONGEST, until=lambda: change.phase.value == phase), change.problem


def test_it_crouches_and_stands_up_through_its_phases(humanoid):
    assert humanoid.body_phase is None
    assert phases_of(humanoid, humanoid.crouch_to(CROUCH)) == ["shifting", "lowering", "settling", "done"]
    assert height(humanoid) == pytest.approx(CROUCH, abs=0.005)
    assert phases_of(humanoid, humanoid.stand_up()) == ["shifting", "rising", "settling", "done"]
    assert height(humanoid) == pytest.approx(STANCE, abs=0.005)
    assert (humanoid.body_phase.value, humanoid.steps) == ("done", 0)


def test_progress_never_falls_back_and_the_speed_limit_holds(humanoid):
    humanoid.reset(height=CROUCH)
    change = humanoid.stand_up()
    percent, speeds = [], []
    while not change.phase.is_last:
        humanoid.step()
        percent.append(change.percent_complete)
        speeds.append(float(humanoid.data.qvel[2]))
    assert all(later >= earlier - 0.5 for earlier, later in pairwise(percent))
    assert percent[-2] < 100 == percent[-1]
    assert max(speeds[100:]) < 1.05 * FASTEST


def test_it_does_not_start_before_its_weight_is_even():
    def when_it_sets_out(impulse: float) -> float:
        humanoid = TrialHumanoid()
        humanoid.reset(height=CROUCH)
        humanoid.push((0.0, impulse, 0.0))
        until_phase(humanoid, humanoid.stand_up(), "rising")
        left, right = (humanoid.data.sensor(f"{side}_foot_touch").data[0] for side in "lr")
        assert left == pytest.approx(right, rel=0.5)
        assert height(humanoid) == pytest.approx(CROUCH, abs=0.01)
        return humanoid.time

    assert when_it_sets_out(8.0) > when_it_sets_out(0.0) + 0.1


def test_a_push_during_the_motion_returns_it_to_shifting(humanoid):
    humanoid.reset(height=CROUCH)
    change = humanoid.stand_up()
    until_phase(humanoid, change, "rising")
    humanoid.push((10.0, 0.0, 0.0))
    assert phases_of(humanoid, change) == ["rising", "shifting", "rising", "settling", "done"]
    assert height(humanoid) == pytest.approx(STANCE, abs=0.005)


def test_a_standing_robot_is_done_at_once(humanoid):
    assert phases_of(humanoid, humanoid.stand_up()) == ["shifting", "settling", "done"]


def test_a_fall_is_reported(humanoid):
    humanoid.reset(height=CROUCH)
    change = humanoid.stand_up()
    until_phase(humanoid, change, "rising")
    humanoid.push((0.0, 80.0, 0.0))
    assert phases_of(humanoid, change)[-1] == "failed"
    assert humanoid.mode is Mode.FALLEN
    assert change.problem.startswith("the robot fell while ")
    assert change.percent_complete < 100


def test_a_phase_that_cannot_end_is_reported(humanoid):
    humanoid.reset(height=CROUCH)
    change = humanoid.stand_up()
    until_phase(humanoid, change, "rising")
    for _ in range(150):
        humanoid.push((4.0, 0.0, 0.0))  # a lateral force of 40 N that does not end
        simulate(humanoid, 0.1)
    assert change.phase.value == "failed"
    assert "not done within 12 s (" in change.problem
    assert "mm off their middle" in change.problem


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        (lambda robot: robot.move_body(0.0), "another command came"),
        (lambda robot: robot.crouch_to(0.5), "another command came"),
        (lambda robot: robot.walk_to(0.5, 0.0, 0.0), "a command to walk came"),
        (lambda robot: robot.set_motor_power(False), "the motors went off"),
    ],
)
def test_the_reason_of_an_interruption_is_reported(humanoid, command, reason):
    change = humanoid.crouch_to(CROUCH)
    until_phase(humanoid, change, "lowering")
    command(humanoid)
    assert (change.phase.value, change.problem) == ("failed", f"{reason} while lowering")


def test_without_motors_it_fails_at_once(humanoid):
    humanoid.set_motor_power(False)
    assert humanoid.stand_up().problem == "the motors are off while shifting"


def test_a_height_that_is_not_finite_is_refused(humanoid):
    with pytest.raises(ValueError, match="expected a finite number in m"):
        humanoid.crouch_to(math.nan)
