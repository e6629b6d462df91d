"""The findings of an audit about a grade that differs from the known one."""

from io import StringIO
from pathlib import Path
from types import SimpleNamespace

import pytest
from rich.console import Console

from autograder.authoring.checks import Scenario, check
from autograder.classroom.audit.kill_matrix import figures, kill_matrix
from autograder.classroom.audit.known_submission import known_submissions, read_known_submission
from autograder.classroom.audit.run import AuditedRun, audit, unproved_checks
from autograder.engine.exercise import FOLDER_VARIABLE, Exercise
from autograder.engine.verdict import CheckVerdict, Grade
from ros_runtime.course_error import CourseError

CORRECT = '"""Style: plain."""\n'
FAULTY = '"""Fault: sleeps\nin the callback (M2)\nCaught by: answers\nAlso fails: ends\n\nCaught by nobody else."""\n'
ON_ANOTHER = '"""Fault: walks too fast\nCaught by: answers\nOn g1: ends\nOn h1: nothing: it is slow"""\n'
HOSTILE = '"""Attack: forks\nOutcome: dies of it\nCaught by: appears\n"""\n'


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Write submissions: folder(kind=source) returns the folder of exercises that holds them, and is in use."""
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path))

    def write(**sources):
        for kind, source in sources.items():
            place = tmp_path / "service" / "known" / kind
            place.mkdir(parents=True)
            (place / "one.py").write_text(source)
        return tmp_path

    return write


@pytest.fixture
def exercise():
    checks = []
    for name in ("appears", "answers", "ends"):

        def judge(run):
            """It does"""

        judge.__name__ = name
        checks.append(check(points=1, on=Scenario("ask"), needs=checks[-1:])(judge))
    return Exercise("service", Path("service"), checks)


def read(folder, kind, robot=None):
    return read_known_submission(folder / "service" / "known" / kind / "one.py", robot)


def run_of(known, **statuses):
    verdicts = [
        CheckVerdict(
            name, name, status.replace("_", " "), int(status == "passed"), 1, help="the machine slept"
        )
        for name, status in statuses.items()
    ]
    return AuditedRun(known, 0, Grade("service", known.name, "namespaces", verdicts), 1.0)


def test_header_is_read_with_its_continued_lines(folder):
    known = read(folder(faulty=FAULTY), "faulty")
    assert known.about == "sleeps in the callback (M2)"
    assert known.caught_by == ("answers",)
    assert known.also_fails == ("ends",)
    assert known.name == "faulty/one"


@pytest.mark.parametrize(
    ("robot", "caught_by"), [(None, ("answers",)), ("g1", ("ends",)), ("h1", ()), ("t1", ("answers",))]
)
def test_a_header_says_what_catches_the_fault_on_another_robot(folder, robot, caught_by):
    assert read(folder(faulty=ON_ANOTHER), "faulty", robot).caught_by == caught_by


def test_header_is_read_from_a_file_that_python_cannot_parse(folder):
    known = read(folder(faulty=FAULTY + "def broken(:\n"), "faulty")
    assert known.caught_by == ("answers",)


@pytest.mark.parametrize(
    ("kind", "source", "complaint"),
    [
        ("correct", "import rclpy\n", "Style"),
        ("correct", '"""Style: plain\nCaught by: ends\n"""', "is in correct/, but"),
        ("faulty", '"""Fault: sleeps"""', "Caught by"),
        ("faulty", '"""Fault: sleeps\nCaught by: ends\nAlso fails: ends\n"""', "twice"),
        ("hostile", '"""Attack: forks\nCaught by: ends\n"""', "Outcome"),
        ("hostile", '"""Attack: forks\nOutcome: dies\n"""', "either"),
        ("odd", '"""Style: plain"""', "expected one of"),
    ],
)
def test_header_with_missing_or_unknown_lines_is_refused(folder, kind, source, complaint):
    where = folder(**{kind: source})
    with pytest.raises(CourseError, match=complaint):
        read(where, kind)


def test_submissions_are_chosen_by_name_or_by_kind_and_name(folder):
    folder(correct=CORRECT, faulty=FAULTY)
    assert len(known_submissions("service")) == 2
    assert [known.kind for known in known_submissions("service", only="faulty/*")] == ["faulty"]
    assert len(known_submissions("service", only="one")) == 2
    assert known_submissions("service", only="two") == []


def test_correct_submission_with_full_marks_is_as_expected(folder):
    known = read(folder(correct=CORRECT), "correct")
    assert run_of(known, appears="passed", answers="passed", ends="passed").surprises() == []


def test_correct_submission_that_fails_is_a_false_failure(folder):
    run = run_of(read(folder(correct=CORRECT), "correct"), appears="passed", answers="failed", ends="not_run")
    assert run.unexpected() == ["answers"]
    assert "answers failed" in run.surprises()[0]


def test_fault_that_is_caught_together_with_a_dependent_check_is_as_expected(folder):
    known = read(folder(faulty=FAULTY), "faulty")
    assert run_of(known, appears="passed", answers="failed", ends="failed").surprises() == []
    assert run_of(known, appears="passed", answers="failed", ends="passed").surprises() == []


@pytest.mark.parametrize("status", ["passed", "not_run"])
def test_fault_that_is_not_caught_is_reported(folder, status):
    run = run_of(read(folder(faulty=FAULTY), "faulty"), appears="passed", answers=status, ends="passed")
    assert run.missed() == ["answers"]
    assert "did not catch it" in run.surprises()[0]


def test_failure_of_an_unrelated_check_is_reported(folder):
    run = run_of(read(folder(faulty=FAULTY), "faulty"), appears="failed", answers="failed", ends="passed")
    assert run.missed() == []
    assert run.unexpected() == ["appears"]


SOONER = '"""Attack: floods\nOutcome: is told\nCaught by: answers\nAlso fails: appears\n"""\n'


@pytest.mark.parametrize(("first", "surprises"), [("failed", 0), ("passed", 1)])
def test_an_attack_may_be_caught_before_the_check_that_names_it(folder, first, surprises):
    run = run_of(read(folder(hostile=SOONER), "hostile"), appears=first, answers="not_run", ends="not_run")
    assert len(run.surprises()) == surprises


def test_hostile_submission_must_get_a_grade(folder):
    run = run_of(read(folder(hostile=HOSTILE), "hostile"), appears="error", answers="not_run", ends="not_run")
    assert any("the machine slept" in surprise for surprise in run.surprises())


def test_check_is_without_a_killer_until_a_submission_that_names_it_fails_it(folder, exercise):
    known = read(folder(faulty=FAULTY), "faulty")
    killed = run_of(known, appears="passed", answers="failed", ends="failed")
    assert unproved_checks([killed], exercise) == ["appears", "ends"]


def test_matrix_shows_every_submission_and_check_and_the_figures(folder, exercise):
    where = folder(correct=CORRECT, faulty=FAULTY)
    runs = [
        run_of(read(where, "correct"), appears="passed", answers="passed", ends="passed"),
        run_of(read(where, "faulty"), appears="passed", answers="failed", ends="passed"),
    ]
    console = Console(width=100, record=True, file=StringIO())
    console.print(kill_matrix(runs, exercise))
    printed = console.export_text()
    for words in ("correct/one", "faulty/one", "appears", "answers", "ends", *figures(runs, exercise)):
        assert words in printed
    assert "kills: 1 of 1 faulty submissions (100 %)" in figures(runs, exercise)
    assert "false failures: 0 in 1 runs of correct submissions" in figures(runs, exercise)


def test_an_ungraded_submission_is_graded_again_at_the_end(folder, exercise, monkeypatch):
    where = folder(correct=CORRECT, faulty=FAULTY)
    gradings = []

    def busy_at_first(known, exercise, repetition, seed, scale, **options):
        gradings.append(known.kind)
        busy = known.kind == "correct" and gradings.count("correct") == 1
        return run_of(known, answers="error" if busy else "passed")

    monkeypatch.setattr("autograder.classroom.audit.run.audit_one", busy_at_first)
    reported = []
    known = [read(where, "correct"), read(where, "faulty")]
    empty = SimpleNamespace(scale=None, earlier_run=lambda *_: None, add=lambda *_: None, write=lambda: None)
    runs = audit(known, exercise, empty, lambda run, is_earlier: reported.append(run), jobs=1)
    assert gradings == ["correct", "faulty", "correct"]
    assert [run.known.kind for run in reported] == ["faulty", "correct"]
    assert [run.grade.status for run in runs] == ["graded", "graded"]
