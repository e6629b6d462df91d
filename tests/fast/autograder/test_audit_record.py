"""A resumed audit reuses recorded verdicts, but never for a changed submission or other inputs."""

import dataclasses
import json

import pytest
from typer.testing import CliRunner

from autograder.classroom.audit.audit_record import AuditRecord, read_runs
from autograder.classroom.audit.known_submission import known_submissions
from autograder.classroom.audit.run import AuditedRun, for_any_fault
from autograder.engine.exercise import load_exercise
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from course_cli.app import app
from ros_runtime.course_error import CourseError

ISOLATED = Isolation(Kind.NAMESPACES, "as a test says")
EXERCISE = load_exercise("battery_service", hidden=True)
CORRECT = known_submissions("battery_service", only="correct/*")
FIRST = CORRECT[0]


def run_of(known, seed=0, status="passed", repetition=0):
    checks = [
        CheckVerdict(check.id, check.title, status, check.points, check.points, help="the machine slept")
        for check in EXERCISE.checks
    ]
    grade = Grade("battery_service", known.name, "namespaces", checks, seed=seed)
    return AuditedRun(known, repetition, grade, 12.5, for_any_fault(EXERCISE))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "audit.json"


def audited(path, run):
    """Write a record as an audit does: it looks up each run before it grades."""
    record = AuditRecord(path, isolation=ISOLATED)
    assert record.earlier_run(run.known, EXERCISE, run.repetition, run.grade.seed) is None
    record.add(run, EXERCISE)


@pytest.fixture
def of_yesterday(path):
    """Return a function: the record of today, that goes on with one that has FIRST with the inputs of seed 4."""
    audited(path, run_of(FIRST, seed=4))

    def record(isolation=ISOLATED, **options):
        return AuditRecord(path, isolation=isolation, earlier=read_runs(path), **options)

    return record


def test_a_run_of_an_unchanged_submission_is_reused_for_the_repetition_with_its_inputs(of_yesterday):
    assert of_yesterday().earlier_run(FIRST, EXERCISE, 1, 4) == run_of(FIRST, seed=4, repetition=1)


def test_other_inputs_checks_isolation_or_scale_and_another_submission_are_graded_anew(of_yesterday):
    visible = load_exercise("battery_service", hidden=False)
    assert of_yesterday().earlier_run(FIRST, EXERCISE, 0, 5) is None
    assert of_yesterday().earlier_run(FIRST, visible, 0, 4) is None
    assert of_yesterday().earlier_run(CORRECT[1], EXERCISE, 0, 4) is None
    first, *others = EXERCISE.checks
    on_g1 = tuple(dataclasses.replace(scenario, robot=("--robot", "g1")) for scenario in first.on)
    other_robot = dataclasses.replace(EXERCISE, checks=[dataclasses.replace(first, on=on_g1), *others])
    assert of_yesterday().earlier_run(FIRST, other_robot, 0, 4) is None
    assert of_yesterday(Isolation(Kind.NONE, "")).earlier_run(FIRST, EXERCISE, 0, 4) is None
    assert of_yesterday(scale=1.0).earlier_run(FIRST, EXERCISE, 0, 4) is None


def test_a_submission_that_was_edited_is_graded_anew(of_yesterday, tmp_path):
    edited = tmp_path / FIRST.path.name
    edited.write_text(FIRST.path.read_text() + "\n# edited\n")
    assert of_yesterday().earlier_run(dataclasses.replace(FIRST, path=edited), EXERCISE, 0, 4) is None


def test_a_submission_that_was_edited_while_it_was_graded_is_graded_anew(path, tmp_path):
    program = tmp_path / FIRST.path.name
    program.write_text(FIRST.path.read_text())
    known = dataclasses.replace(FIRST, path=program)
    record = AuditRecord(path, isolation=ISOLATED)
    assert record.earlier_run(known, EXERCISE, 0, 4) is None
    program.write_text(FIRST.path.read_text() + "\n# edited\n")
    record.add(run_of(known, seed=4), EXERCISE)
    resumed = AuditRecord(path, isolation=ISOLATED, earlier=read_runs(path))
    assert resumed.earlier_run(known, EXERCISE, 0, 4) is None


def test_a_reused_run_is_compared_with_the_present_header(of_yesterday, path):
    record = of_yesterday()
    wrong = dataclasses.replace(FIRST, caught_by=(EXERCISE.checks[0].id,))
    assert record.earlier_run(wrong, EXERCISE, 0, 4).surprises()
    record.write()
    assert "did not catch it" in json.loads(path.read_text())["battery_service"][0]["surprises"][0]


def test_what_was_not_graded_is_graded_again(path):
    audited(path, run_of(FIRST, status="error"))
    record = AuditRecord(path, isolation=ISOLATED, earlier=read_runs(path))
    assert record.earlier_run(FIRST, EXERCISE, 0, 0) is None


def test_the_file_is_whole_after_every_run_and_keeps_what_it_had(of_yesterday, path):
    record = of_yesterday()
    record.add(run_of(CORRECT[1]), EXERCISE)
    record.add(run_of(FIRST, seed=4, status="failed"), EXERCISE)
    runs = json.loads(path.read_text())["battery_service"]
    assert [(run["submission"], run["grade"]["checks"][0]["status"]) for run in runs] == [
        (FIRST.name, "failed"),
        (CORRECT[1].name, "passed"),
    ]


@pytest.mark.parametrize("text", ["", "[]", '{"battery_service": [{"grade": {}}]}', '{"a": 1}'])
def test_a_file_that_is_not_a_record_is_refused_and_not_changed(path, text):
    path.write_text(text)
    with pytest.raises(CourseError, match=r"was not written by course audit --json.*leave out --resume"):
        read_runs(path)
    ran = CliRunner().invoke(app("audit"), ["audit", "battery_service", "--json", str(path), "--resume"])
    assert ran.exit_code == 2
    assert path.read_text() == text


def test_an_interrupted_audit_prints_how_to_resume_and_then_grades_the_rest(path, monkeypatch):
    graded, printed = [], []

    def audit_one(known, exercise, repetition, seed, *_, **__):
        graded.append(known.name)
        return run_of(known, seed + repetition)

    def interrupted(console, run, earlier):
        printed.append(run.known.name)
        if len(printed) == 2:
            raise KeyboardInterrupt

    monkeypatch.setattr("autograder.classroom.audit.run.audit_one", audit_one)
    command = ["audit", "battery_service", "--only", "correct/*", "--json", str(path)]
    with monkeypatch.context() as patch:
        patch.setattr("autograder.classroom.commands.audit.print_progress", interrupted)
        ran = CliRunner().invoke(app("audit"), command)
    assert ran.exit_code == 1
    assert "add --resume to continue" in " ".join(ran.output.split())

    graded.clear()
    ran = CliRunner().invoke(app("audit"), [*command, "--resume"])
    assert ran.exit_code == 0, ran.output
    assert sorted(printed + graded) == [known.name for known in CORRECT]
    assert ran.output.count("(reused)") == len(printed)
    assert f"0 in {len(CORRECT)} runs of correct" in ran.output


def test_resuming_needs_the_earlier_file():
    ran = CliRunner().invoke(app("audit"), ["audit", "battery_service", "--resume"])
    assert ran.exit_code == 2
    assert "add --json FILE" in ran.output


def test_a_name_that_matches_nothing_leaves_the_file_as_it_is(of_yesterday, path):
    before = path.read_text()
    command = ["audit", "battery_service", "--only", "correct/misspelt", "--json", str(path)]
    assert CliRunner().invoke(app("audit"), command).exit_code == 2
    assert path.read_text() == before
