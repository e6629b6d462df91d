"""A few runs of each trial; `./course bench --trial all` makes the long ones."""

import pytest
from rich.console import Console

from bench.robot import run_trials, walking
from bench.robot.table import bench_robot, table_of
from bench.robot.walking import Servo, Soak


def test_short_trials_of_stops_and_reaches_meet_their_references():
    rows = run_trials(["stops", "reaches"], quick=True)
    assert [row.title.split(",")[0] for row in rows] == ["stop mid-walk", "reach ≤ 0.55 m from the shoulder"]
    assert all(row.met for row in rows), [row.failures or row.measured for row in rows]
    assert table_of(rows).row_count == 2


def test_hands_come_to_the_poses_they_can_reach_and_the_others_are_refused():
    (row,) = run_trials(["hand_poses"], quick=True)
    assert (row.met, row.successes, row.runs) == (True, 40, 40), row.failures
    assert "8 out of reach" in row.measured


def test_speed_is_measured_for_bare_physics_and_with_the_controller():
    titles = [row.title for row in run_trials(["speed"], quick=True)]
    assert titles == ["speed, bare mj_step", "speed, standing", "speed, walking"]


@pytest.mark.parametrize("style", Servo.STYLES)
def test_a_students_controller_reaches_its_goal(style):
    outcome = Servo().run((style, 20, (0.5, -0.3, 1.2)))
    assert outcome.success, outcome.note
    assert outcome.values["duration_s"] < 15


def test_an_unknown_trial_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"'dance' is not known.*goals, limits, stops"):
        run_trials(["dance"])


def test_a_soak_names_the_command_at_its_last_fall(monkeypatch):
    commands, falls = iter(["goal", "velocity", "stop"]), iter([False, True, False])
    monkeypatch.setattr(walking, "command_at_random", lambda humanoid, chance: next(commands))
    monkeypatch.setattr(walking, "has_fallen", lambda humanoid: next(falls))
    monkeypatch.setattr(walking, "simulate", lambda humanoid, seconds: [humanoid.step() for _ in range(200)])
    outcome = Soak().run((300, 2.5))
    assert outcome.note == "1 falls in 3 commands, the last at velocity"


def test_the_table_is_followed_by_the_runs_that_failed(monkeypatch):
    monkeypatch.setattr(walking, "SERVO_TIME_LIMIT", 0.1)
    console = Console(record=True, width=200)
    bench_robot(console, ["servo"], quick=True, jobs=1)
    printed = console.export_text()
    assert "The humanoid's trials" in printed
    assert "not there after 0.1 s" in printed
