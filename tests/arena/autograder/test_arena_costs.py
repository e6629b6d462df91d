"""`course bench --arena`: which costs are measured and written, without their values."""

from __future__ import annotations

import json

import pytest
from rich.console import Console

from autograder.classroom.audit.known_submission import known_submission
from bench import overview
from bench.arena import arena_costs, tables
from bench.arena.arena_costs import ArenaCost, Cost, Costs, SubmissionCost, measure
from bench.arena.processor_time import CannotBeMeasured, metered_group
from bench.arena.tables import bench_arenas
from developer.bench import bench
from ros_runtime.course_error import CourseError

PHASES = {"interpreter", "imports", "discovery", "settling", "scenario", "end"}


def is_metered():
    try:
        with metered_group():
            return True
    except CannotBeMeasured:
        return False


@pytest.mark.skipif(not is_metered(), reason="processor time needs control groups, which only root can make")
def test_an_arena_and_a_grading_are_measured():
    costs = measure(arenas=[arena_costs.ARENAS[1]], submissions=["patterns"], runs=1)
    (arena,), (graded,) = costs.arenas, costs.submissions
    assert (arena.exercise, arena.scenario, graded.exercise) == (*arena_costs.ARENAS[1], "patterns")
    assert set(arena.phases) >= PHASES
    assert 0 < arena.floor_s < arena.wall_s
    assert arena.cpu_s > 0
    assert arena.opening.cpu_s > 0
    assert 0 < graded.floor_s < graded.wall_s


def test_costs_are_written_as_the_contract_says_and_read_back(tmp_path):
    costs = Costs(
        [ArenaCost("e", "s", 0.5, 1.0, 0.2, Cost(1.0, 1.5), {"scenario": Cost(0.1, 0.2)})],
        [SubmissionCost("e", 3.0, 5.0, 2.0)],
    )
    record = json.loads(json.dumps(costs.to_json()))
    assert {"exercise", "scenario", "cpu_s", "wall_s", "floor_s", "phases"} <= set(record["arenas"][0])
    assert record["arenas"][0]["phases"] == {"scenario": {"cpu_s": 0.1, "wall_s": 0.2}}
    assert record["submissions"] == [{"exercise": "e", "cpu_s": 3.0, "wall_s": 5.0, "floor_s": 2.0}]
    assert Costs.from_json(record).to_json() == costs.to_json()


def test_two_runs_are_compared_as_ratios(tmp_path, monkeypatch):
    now, before = (
        Costs(submissions=[SubmissionCost("walk", cpu, wall, 2.0)]) for cpu, wall in ((3, 5), (6, 20))
    )
    (tmp_path / "before.json").write_text(json.dumps(before.to_json()))
    monkeypatch.setattr(tables, "measure", lambda **options: now)
    console = Console(record=True, width=80)
    bench_arenas(
        console,
        arenas=False,
        submissions=["walk"],
        against=tmp_path / "before.json",
        json_file=tmp_path / "now.json",
        runs=1,
        jobs=2,
    )
    row = next(line for line in console.export_text().splitlines() if "walk" in line)
    assert [cell.strip() for cell in row.split("│")[2:-1]] == [
        "3.00",
        "5.00",
        "2.00",
        "6.00 / 20.00",
        "0.50 / 0.25",
    ]
    assert json.loads((tmp_path / "now.json").read_text()) == json.loads(json.dumps(now.to_json()))


def test_the_correct_server_of_the_fairness_rows_exists():
    assert known_submission(overview.EXERCISE, overview.THREADED).kind == "correct"


def test_an_unknown_exercise_is_refused():
    with pytest.raises(CourseError, match="there is no exercise 'patternz'"):
        bench(submission=["patternz"])
