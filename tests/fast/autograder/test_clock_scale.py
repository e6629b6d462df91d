"""The scale of an arena's clock: high if no robot has to move, low if the machine is busy."""

import pytest

from autograder.authoring.checks import MAY_REST, Scenario
from autograder.engine import clock_scale
from autograder.engine.clock_scale import FAST_SCALE, USUAL, ClockScale

WALK = Scenario("walk")
LIGHT = (Scenario("ask", robot=(MAY_REST,)), Scenario("good", robot=None, student="program"))


@pytest.fixture
def load(monkeypatch):
    """Set the load of this machine: runnable processes per core."""
    monkeypatch.setattr(clock_scale, "library_path", lambda: "libscaled_clock.so")

    def set_load(per_core):
        monkeypatch.setattr(clock_scale, "_load_per_core", lambda: per_core)

    set_load(0.2)
    return set_load


def test_a_robot_that_has_to_move_goes_at_the_usual_scale(load):
    assert ClockScale().first_scale(WALK) == USUAL


@pytest.mark.parametrize("scenario", LIGHT, ids=["a robot that rests", "no robot"])
def test_without_a_robot_to_move_an_idle_machine_goes_faster_and_a_busy_one_does_not(load, scenario):
    assert ClockScale().first_scale(scenario) == FAST_SCALE
    load(4.0)
    assert ClockScale().first_scale(scenario) == USUAL


def test_after_an_arena_was_late_the_others_go_at_the_usual_scale(load):
    scale = ClockScale()
    scale.was_late()
    assert scale.first_scale(LIGHT[0]) == USUAL


@pytest.mark.parametrize(
    ("first", "was_strained", "second"),
    [
        (FAST_SCALE, False, USUAL),
        (FAST_SCALE, True, USUAL),
        (USUAL, False, USUAL),
        (USUAL, True, 2.0),
        (2.0, True, 1.0),
    ],
)
def test_no_point_is_lost_at_a_fast_scale(load, first, was_strained, second):
    assert ClockScale().retry_scale(first, was_strained) == second


def test_a_requested_scale_is_kept(load):
    scale = ClockScale(3.0)
    assert scale.first_scale(LIGHT[0]) == scale.retry_scale(3.0, too_fast=False) == 3.0


def test_without_the_clocks_library_all_arenas_run_in_real_time(load, monkeypatch):
    monkeypatch.setattr(clock_scale, "library_path", lambda: None)
    assert {ClockScale().first_scale(scenario) for scenario in (WALK, *LIGHT)} == {1.0}


def test_an_arena_that_is_late_is_tried_at_every_slower_scale(load):
    assert ClockScale().attempts(FAST_SCALE) == (10.0, 5.0, 2.0, 1.0, 1.0)
