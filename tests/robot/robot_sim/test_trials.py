"""The trials, a few runs of each: the long ones are for `python -m robot_sim.trials`."""

import pytest

from robot_sim.trials import run_trials, servo
from robot_sim.trials.table import table_of


def test_quick_stops_and_reaches_meet_their_references():
    rows = run_trials(["stops", "reaches"], quick=True)
    assert [row.title.split(",")[0] for row in rows] == ["stop mid-walk", "reach ≤ 0.55 m from the shoulder"]
    assert all(row.met for row in rows), [row.failures or row.measured for row in rows]
    assert table_of(rows).row_count == 2


def test_speed_is_told_for_bare_physics_and_with_the_controller():
    titles = [row.title for row in run_trials(["speed"], quick=True)]
    assert titles == ["speed, bare mj_step", "speed, standing", "speed, walking"]


@pytest.mark.parametrize("style", servo.STYLES)
def test_a_students_controller_reaches_its_goal(style):
    outcome = servo.run((style, 20, (0.5, -0.3, 1.2)))
    assert outcome.success, outcome.note
    assert outcome.values["duration_s"] < 15


def test_an_unknown_trial_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"'dance' is not known.*goals, limits, stops"):
        run_trials(["dance"])
