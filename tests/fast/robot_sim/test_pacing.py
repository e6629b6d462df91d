"""A delayed simulation reports its lag."""

import pytest

from robot_sim.ros.pacing import Pacing


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr("robot_sim.ros.pacing.time.monotonic", lambda: now[0])
    return now


def test_a_dropped_lag_is_still_reported(clock):
    pacing = Pacing()
    pacing.restart(5.0)
    clock[0] += 3.0
    assert pacing.wall_time_until(5.0) == 0.0
    assert pacing.lag(5.0) == 0.0, "let go of"
    pacing.restart(5.0)
    assert pacing.take_worst_lag() == pytest.approx(3.0)
    assert pacing.take_worst_lag() == 0.0


def test_a_simulation_that_is_ahead_has_no_lag(clock):
    pacing = Pacing()
    pacing.restart(0.0)
    assert pacing.wall_time_until(0.5) == pytest.approx(0.5)
    assert pacing.take_worst_lag() == 0.0
