"""Hidden inputs are drawn anew for each batch, but a resumed batch keeps its inputs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from autograder.authoring.checks import Check, Scenario
from autograder.classroom.batch.batch_record import BatchRecord
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.seeds import Seeds
from autograder.classroom.batch.selection import require_seed
from autograder.classroom.batch.shards import Shard
from autograder.classroom.class_grading.prepared_batch import choose_seeds
from autograder.engine import grading
from autograder.engine.arena_run import NotGraded
from autograder.engine.exercise import Exercise, exercise_names, load_exercise
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from ros_runtime.course_error import CourseError
from student_work import work_at

NEW = BatchRequest(Path("submitted"), Path("graded"))
RECORD = BatchRecord("ended", "2026-03-01T12:00:00+00:00", 77, False, False, "namespaces", 2)
OLD_GRADES = [Grade("walk_to", "anna", "namespaces", seed=0)]


def test_each_batch_has_its_own_seed_and_a_resumed_batch_keeps_it():
    assert len({choose_seeds(NEW, RECORD, (), ()).batch for _ in range(5)}) == 5
    for goes_on in (
        replace(NEW, resume=True),
        replace(NEW, students=("anna",)),
        replace(NEW, exercises=("walk_to",)),
        replace(NEW, watch=True),
    ):
        assert choose_seeds(goes_on, RECORD, (), ()) == Seeds(77)
        each = replace(RECORD, seed_per_student=True)
        assert choose_seeds(goes_on, each, (), ()) == Seeds(77, per_student=True)
        watched = replace(RECORD, seed_per_submission=True)
        assert choose_seeds(goes_on, watched, (), ()) == Seeds(77, per_submission=True)


def test_a_given_seed_is_used_and_an_older_versions_seed_is_read_from_its_grades():
    given = replace(NEW, seed=5, resume=True)
    assert choose_seeds(given, RECORD, (), ()) == Seeds(5)
    assert choose_seeds(replace(NEW, resume=True), None, OLD_GRADES, ()) == Seeds(0)
    assert choose_seeds(NEW, None, OLD_GRADES, ()) != Seeds(0)


def test_shards_use_the_same_seed_unless_their_submissions_differ(tmp_path):
    works = []
    for student in ("anna", "bert"):
        path = tmp_path / f"{student}.py"
        path.write_text(f"name = {student!r}\n")
        works.append(work_at(path, student, "walk_to"))
    first, second = (replace(NEW, shard=Shard(number, 2)) for number in (1, 2))
    seeds = choose_seeds(first, None, (), works)
    assert seeds == choose_seeds(second, None, (), works[::-1])
    (tmp_path / "bert.py").write_text("name = 'Bert'\n")
    changed = choose_seeds(second, None, (), works)
    assert changed != seeds
    assert choose_seeds(replace(first, resume=True), replace(RECORD, seed=seeds.batch), (), works) == seeds


def test_with_watch_a_resubmission_is_graded_with_other_inputs():
    seeds = choose_seeds(replace(NEW, watch=True), None, (), ())
    before, after = {"walk_to.py": "x = 1\n"}, {"walk_to.py": "x = 2\n"}
    assert seeds.of("anna", before) == seeds.of("anna", dict(before))
    assert len({seeds.of("anna", before), seeds.of("anna", after), seeds.of("bert", before)}) == 3
    require_seed([Grade("walk_to", "anna", "namespaces", seed=seeds.of("anna", before))], seeds)


@pytest.mark.parametrize(
    "options", [{"students": ("anna",)}, {"watch": True}, {"json_file": Path("all.json")}]
)
def test_a_shard_is_a_part_of_the_whole_class(options):
    with pytest.raises(CourseError, match=r"--shard (grades )?a part"):
        BatchRequest(Path("submitted"), Path("graded"), shard=Shard(1, 2), **options)


def test_inputs_of_visible_checks_have_the_same_seed_in_every_batch(tmp_path, monkeypatch):
    seen: dict[str, int] = {}

    def look(run, *_):
        seen[run.scenario.name] = run.seed
        raise NotGraded("only the seeds are looked at")

    shown, both, kept_back = (Scenario(name) for name in ("shown", "both", "kept_back"))
    checks = [
        Check("A", 1, lambda *_: None, (shown, both), id="a"),
        Check("B", 1, lambda *_: None, (both, kept_back), id="b", hidden=True),
    ]
    monkeypatch.setattr(grading, "run_in_arena", look)
    monkeypatch.setattr(grading, "require_hidden", lambda paths: None)
    exercise = Exercise("made_up", tmp_path, checks)
    isolation = Isolation(Kind.NAMESPACES, "as a test says")
    options = grading.GradingOptions(seed=77, isolation=isolation)
    grading.grade(Submission("made_up", "anna", {}), exercise, options)
    assert seen == {"shown": grading.VISIBLE_SEED, "both": grading.VISIBLE_SEED, "kept_back": 77}


def test_most_exercises_draw_inputs_of_hidden_checks():
    drawing = [
        name
        for name in exercise_names()
        if any(
            callable(scenario.inputs)
            for check in load_exercise(name, hidden=True).checks
            for scenario in check.on
        )
    ]
    assert {"battery_service", "walk_to", "cancellable_walk"} <= set(drawing)
