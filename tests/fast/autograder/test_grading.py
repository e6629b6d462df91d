"""The verdicts for given transcripts: dependencies of checks, infrastructure failures, overload."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from autograder.authoring.checks import Scenario, check
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, NoOccasion, expect
from autograder.engine import grading
from autograder.engine.arena_run import NotGraded
from autograder.engine.exercise import Exercise
from autograder.engine.stop import Stop, Stopped
from autograder.engine.submission import Submission
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from records import robot
from ros_runtime.course_error import CommandFailed

ISOLATED = Isolation(Kind.NAMESPACES, "given")
SUBMISSION = Submission("battery_service", "ada", {"battery_service.py": ""})
FIRST, SECOND = Scenario("first"), Scenario("second")
BEGINNING = (ev.NodeStarted(t=0.0), ev.NodeReady(t=0.0, waited=0.1))


def graded(exercise, *, stop=None, watcher=None, **options):
    options = grading.GradingOptions(**{"isolation": ISOLATED, **options})
    return grading.grade(SUBMISSION, exercise, options, watcher or grading.Watcher(), stop=stop)


def transcript(scenario, *, lag=0.0, mark=None, scale=5.0):
    events = [*BEGINNING, robot(1.0), robot(2.0, lag=lag)]
    if mark:
        events.append(ev.Mark(t=3.0, name=mark))
    events.append(ev.ScenarioEnded(t=3.0))
    return Transcript.from_events(scenario.name, {}, events, scale)


def exercise(*checks):
    return Exercise("anything", Path("anything"), checks)


@pytest.fixture
def two_checks():
    @check(points=2, on=FIRST)
    def base(run):
        """The base holds."""
        expect(bool(run.all(ev.Mark)), expected="a mark", observed="none", help="Set a mark.", at=1.5)

    @check(points=3, on=SECOND, needs=base)
    def above(run):
        """What stands on it holds"""

    return exercise(base, above)


def arenas(monkeypatch, answer):
    """Replace arenas by `answer(scenario, scale)`; return the list of the runs."""
    ran = []

    def run_in_arena(run, stop=None, arenas=None):
        ran.append((run.scenario.name, run.scale))
        return answer(run.scenario, run.scale)

    monkeypatch.setattr(grading, "run_in_arena", run_in_arena)
    return ran


def statuses(grade):
    return {check.id: check.status for check in grade.checks}


def test_full_marks(monkeypatch, two_checks):
    arenas(monkeypatch, lambda scenario, scale: transcript(scenario, mark="here"))
    grade = graded(two_checks)
    assert (grade.status, grade.score, grade.max_score, grade.all_passed) == ("graded", 5, 5, True)


def test_a_failure_has_observation_time_and_next_step_and_dependent_checks_are_not_run(
    monkeypatch, two_checks
):
    arenas(monkeypatch, lambda scenario, scale: transcript(scenario))
    grade = graded(two_checks)
    assert statuses(grade) == {"base": "failed", "above": "not run"}
    failed, not_run = grade.checks
    assert (failed.expected, failed.observed, failed.help, failed.robot_time) == (
        "a mark",
        "none",
        "Set a mark.",
        1.5,
    )
    assert "The base holds" in not_run.help
    assert (grade.status, grade.score) == ("graded", 0)


def test_only_after_another_failure_a_check_without_an_answer_refers_to_the_others(monkeypatch):
    @check(points=1, on=FIRST)
    def first(run):
        """The first has an answer"""
        raise NoOccasion("it arrives")

    @check(points=1, on=SECOND)
    def second(run):
        """The second has an answer"""
        raise NoOccasion("it stops")

    arenas(monkeypatch, lambda scenario, scale: transcript(scenario))
    helps = [verdict.help for verdict in graded(exercise(first, second), jobs=1).checks]
    assert [help.startswith("Fix what the other checks report first") for help in helps] == [False, True]


def test_an_arena_that_fails_is_tried_again_and_then_not_graded(monkeypatch, two_checks):
    def answer(scenario, scale):
        raise NotGraded("no room")

    ran = arenas(monkeypatch, answer)
    grade = graded(two_checks, jobs=1)
    assert statuses(grade) == {"base": "error", "above": "error"}
    assert (grade.status, grade.score) == ("not graded", None)
    assert "no room" in grade.checks[0].help
    assert len(ran) > 1


def test_a_check_that_raises_costs_no_points(monkeypatch):
    @check(points=1, on=FIRST)
    def broken(run):
        """Broken"""
        raise KeyError("oops")

    arenas(monkeypatch, lambda scenario, scale: transcript(scenario))
    grade = graded(exercise(broken))
    assert (grade.status, grade.checks[0].status) == ("not graded", "error")
    assert "oops" in grade.checks[0].help


def test_events_missing_by_the_arenas_fault_are_retried_and_then_not_graded(monkeypatch, two_checks):
    def answer(scenario, scale):
        whole = transcript(scenario, mark="here")
        return replace(whole, events=[event for event in whole.events if event.kind != "scenario_ended"])

    ran = arenas(monkeypatch, answer)
    grade = graded(two_checks, jobs=1)
    assert (grade.status, statuses(grade)["base"]) == ("not graded", "error")
    assert grade.checks[0].help == "Not graded: first: the record breaks off at 3.0 s"
    assert [name for name, _ in ran].count("first") == 4


@pytest.mark.parametrize("slow_enough", [2.0, 1.0])
def test_a_missing_event_is_retried_on_slower_clocks(monkeypatch, slow_enough):
    @check(points=1, on=FIRST)
    def sees(run):
        """It is seen"""
        if not run.all(ev.Mark):
            raise CannotBeJudged("nothing was seen")

    ran = arenas(
        monkeypatch,
        lambda scenario, scale: transcript(
            scenario, mark="here" if scale <= slow_enough else None, scale=scale
        ),
    )
    assert graded(exercise(sees), scale=5.0).all_passed
    assert [scale for _, scale in ran] == [5.0, 5.0, 2.0, 1.0][: 3 if slow_enough == 2.0 else 4]


def test_an_overloaded_run_is_repeated_more_slowly_before_it_is_judged(monkeypatch, two_checks):
    def answer(scenario, scale):
        return transcript(
            scenario, lag=2.0 if scale > 1 else 0.0, mark="here" if scale == 1 else None, scale=scale
        )

    ran = arenas(monkeypatch, answer)
    grade = graded(two_checks, jobs=1, scale=5.0)
    assert grade.all_passed
    assert [scale for name, scale in ran if name == "first"] == [5.0, 2.0, 1.0]


def test_a_machine_that_is_too_slow_even_at_scale_1_gives_no_grade(monkeypatch, two_checks):
    arenas(monkeypatch, lambda scenario, scale: transcript(scenario, lag=2.0, scale=scale))
    grade = graded(two_checks)
    assert grade.status == "not graded"
    assert "too busy" in grade.checks[0].help


def without_robot(scenario, scale, *, starved):
    events = [*BEGINNING, ev.Starved(t=3.0, seconds=starved), ev.ScenarioEnded(t=3.0)]
    return Transcript.from_events(scenario.name, {}, events, scale)


@pytest.mark.parametrize(("timed", "scales"), [(True, [5.0, 2.0]), (False, [5.0])])
def test_a_program_that_got_no_processor_is_run_again_more_slowly_where_time_counts(
    monkeypatch, timed, scales
):
    @check(points=1, on=Scenario("program", robot=None, student="program", timed=timed))
    def ends(run):
        """It ends"""

    ran = arenas(
        monkeypatch,
        lambda scenario, scale: without_robot(scenario, scale, starved=3.0 if scale > 2 else 0.1),
    )
    assert graded(exercise(ends), scale=5.0).all_passed
    assert [scale for _, scale in ran] == scales


@pytest.mark.parametrize(("starved", "status"), [(2.0, "failed"), (5.0, "not graded")])
def test_a_node_that_never_appeared_is_judged_unless_it_lost_half_its_time(
    monkeypatch, two_checks, starved, status
):
    def answer(scenario, scale):
        absent = ev.NodeNotReady(t=6.0, missing=["/call"], offered=["/cal"], waited=6.0)
        waiting = ev.Starved(t=6.0, seconds=0.8, altogether=starved)
        events = [BEGINNING[0], absent, waiting, ev.ScenarioEnded(t=6.0)]
        return Transcript.from_events(scenario.name, {}, events, 1.0)

    arenas(monkeypatch, answer)
    grade = graded(two_checks)
    assert (grade.status if status == "not graded" else grade.checks[0].status) == status


@pytest.mark.parametrize("fast_enough", [2.0, 1.0])
def test_a_failure_on_a_busy_machine_counts_only_if_it_recurs_on_an_idle_one(
    monkeypatch, two_checks, fast_enough
):
    def answer(scenario, scale):
        keeps_up = scale <= fast_enough
        return transcript(
            scenario, lag=0.0 if keeps_up else 0.3, mark="here" if keeps_up else None, scale=scale
        )

    ran = arenas(monkeypatch, answer)
    assert graded(two_checks, jobs=1, scale=5.0).all_passed
    assert [scale for name, scale in ran if name == "first"][-1] == fast_enough


@pytest.mark.parametrize(
    ("marks", "status"), [(["here"], "passed"), ([None, "here"], "passed"), ([None, None, "here"], "failed")]
)
def test_a_failure_counts_only_if_it_occurs_twice(monkeypatch, marks, status):
    @check(points=1, on=FIRST)
    def ends(run):
        """It ends well"""
        expect(bool(run.all(ev.Mark)), expected="a mark", observed="none", help="Set a mark.")

    coming = iter(marks)
    ran = arenas(monkeypatch, lambda scenario, scale: transcript(scenario, mark=next(coming)))
    grade = graded(exercise(ends), scale=5.0)
    assert statuses(grade) == {"ends": status}
    assert len(ran) == min(len(marks), 2)


def test_the_running_scenario_is_reported(monkeypatch, two_checks):
    arenas(monkeypatch, lambda scenario, scale: transcript(scenario, mark="here"))
    reported = []
    watcher = grading.Watcher(
        on_running=lambda scenarios: reported.append([scenario.name for scenario in scenarios])
    )
    graded(two_checks, watcher=watcher, jobs=1)
    assert [names for names in reported if names] == [["first"], ["second"]]
    assert reported[-1] == []


def test_hidden_checks_are_refused_without_isolation(monkeypatch):
    @check(points=1, on=FIRST)
    def secret(run):
        """Secret"""

    ran = arenas(monkeypatch, lambda scenario, scale: transcript(scenario))
    with pytest.raises(CommandFailed, match="no namespaces here"):
        graded(exercise(replace(secret, hidden=True)), isolation=Isolation(Kind.NONE, "no namespaces here"))
    assert ran == []


def test_hidden_checks_are_refused_where_a_sandbox_would_show_them(monkeypatch):
    @check(points=1, on=FIRST)
    def secret(run):
        """Secret"""

    ran = arenas(monkeypatch, lambda scenario, scale: transcript(scenario))
    shown = replace(exercise(replace(secret, hidden=True)), folder=Path(sys.prefix, "share/course/secrets"))
    with pytest.raises(CommandFailed, match=r"secrets lies in .*, which students' programs can read"):
        graded(shown)
    assert ran == []


def test_without_isolation_a_grade_is_labelled_untrusted(monkeypatch, two_checks):
    arenas(monkeypatch, lambda scenario, scale: transcript(scenario, mark="here"))
    grade = graded(two_checks, isolation=Isolation(Kind.NONE, "no namespaces here"))
    assert grade.to_json()["isolation"] == "untrusted"


def test_where_no_points_can_be_lost_the_first_failure_may_count(monkeypatch, two_checks):
    ran = arenas(monkeypatch, lambda scenario, scale: transcript(scenario))
    grade = graded(two_checks, jobs=1, checks_without_retry=["base"])
    assert statuses(grade) == {"base": "failed", "above": "not run"}
    assert [name for name, _ in ran] == ["first"]


@pytest.mark.parametrize(("said", "runs"), [("SyntaxError: '(' was never closed", 1), ("OSError: busy", 2)])
def test_a_program_that_python_cannot_compile_is_not_retried(monkeypatch, two_checks, said, runs):
    def ends_at_once(scenario, scale):
        lines = [ev.NodeOutput(t=0.2, stream="stderr", text=text) for text in ('  File "a.py", line 3', said)]
        events = [ev.NodeStarted(t=0.0), *lines, ev.NodeExited(t=0.3, returncode=1), ev.ScenarioEnded(t=0.4)]
        return Transcript.from_events(scenario.name, {}, events)

    ran = arenas(monkeypatch, ends_at_once)
    retried = []
    grade = graded(two_checks, jobs=1, watcher=grading.Watcher(on_retry=retried.append))
    assert statuses(grade) == {"base": "failed", "above": "not run"}
    assert [name for name, _ in ran].count("first") == runs
    assert len(retried) == runs - 1


def test_a_stop_ends_the_grading_without_a_grade_and_starts_no_other_arena(monkeypatch, two_checks):
    stop = Stop()

    def ended(scenario, scale):
        stop.set()
        raise NotGraded("the arena was ended on request")

    ran = arenas(monkeypatch, ended)
    with pytest.raises(Stopped):
        graded(two_checks, jobs=1, stop=stop)
    assert [name for name, _ in ran] == ["first"]
