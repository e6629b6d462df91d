"""Obligations: on which scenarios a check of them is judged and retried, and the text of its failure."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import pytest
from test_grading import BEGINNING, ISOLATED, SUBMISSION, arenas, exercise, statuses

from autograder.authoring.checks import RESTING, Scenario, checks_in
from autograder.authoring.diagnosis.missing import Missing
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.authoring.obligation import check_of, obligation, whole_run
from autograder.engine import grading
from records import failure_of, robot

ASK = Scenario("in_order", {"steps": [["ask", 1], ["wait", 2.5]]}, robot=RESTING)
DRAWN = Scenario(
    "drawn", lambda random: {"steps": [["ask", 1], ["unplug"], ["wait", 2.5], ["ask", 2]]}, robot=RESTING
)

ONE_JOB = grading.GradingOptions(jobs=1, isolation=ISOLATED)


def run_of(scenario, *, said="", steps_done=None, missing=()):
    """A run of a sequence with one step per second; the node prints `said` at the end of the last step."""
    steps = scenario.draw(0)["steps"]
    done = len(steps) if steps_done is None else steps_done
    marks = [ev.Mark(t=float(number), name=f"step {number}") for number in range(1, done + 1)]
    printed = [ev.NodeOutput(t=done - 0.5, stream="stdout", text=said)] if said else []
    end = ev.ScenarioEnded(t=len(steps) + 1.0)
    seen = [robot(float(second)) for second in range(1, len(steps) + 2)]
    events = [event for event in (*BEGINNING, *marks, *printed, *seen, end) if event.kind not in missing]
    return Transcript.from_events(scenario.name, scenario.draw(0), events, 5.0)


@obligation(2, of=whole_run)
def prints(run):
    """It prints something good."""
    output = run.first(ev.NodeOutput)
    if output is None:
        return None
    if output.text == "bad":
        raise Failure(expected="something good", observed="bad", help="Print good.", at=output.t)
    return output.text


def check_on(*scenarios):
    return replace(check_of(prints, points=2, on=scenarios), id="prints")


def test_its_title_has_clauses_sentence_and_situations():
    check = check_on(ASK)
    assert (check.clauses, check.title, check.obligations) == ((2,), "It prints something good", (prints,))
    assert prints.judge(run_of(ASK, said="good")) == {"good": 1}


def test_a_failure_points_to_the_lesson_of_the_obligation_unless_its_check_names_one():
    whole = replace(prints, require=lambda run: "always", see="02_services#first-file")
    taught = replace(prints, see="02_services#conventions")
    for see, expected in (("", taught.see), ("02_services#nan", "02_services#nan")):
        assert (
            failure_of(check_of([whole, taught], on=ASK, see=see).run, [run_of(ASK, said="bad")]).see
            == expected
        )
    assert check_of([whole, taught], on=ASK).see == whole.see  # if none of them fails alone


def test_its_id_is_the_name_of_its_variable():
    first, second = check_of(prints, on=ASK), check_of(prints, on=ASK)
    module = SimpleNamespace(prints_something=first, again=second, alias=first)
    assert [check.id for check in checks_in(module)] == ["prints_something", "again"]


def test_a_submission_for_which_no_obligation_applies_fails(monkeypatch):
    ran = arenas(monkeypatch, lambda scenario, scale: run_of(scenario))
    grade = grading.grade(SUBMISSION, exercise(check_on(ASK)), ONE_JOB)
    assert statuses(grade) == {"prints": "failed"}
    assert grade.checks[0].expected == "an answer from which this can be judged: It prints something good"
    # each at a lower scale, because the machine may be the cause
    assert len(ran) == grading.MOST_ATTEMPTS["error"]


def test_an_obligation_that_applies_on_a_slower_clock_is_enough(monkeypatch):
    arenas(monkeypatch, lambda scenario, scale: run_of(scenario, said="good" if scale < 5.0 else ""))
    grade = grading.grade(SUBMISSION, exercise(check_on(ASK)), ONE_JOB)
    assert statuses(grade) == {"prints": "passed"}


def test_a_run_with_missing_steps_does_not_pass():
    with pytest.raises(Missing, match="step 2 of the scenario"):
        check_on(ASK).run([run_of(ASK, said="good", steps_done=1)])


def test_only_checks_on_drawn_sequences_meet_any_fault():
    assert not check_on(ASK).can_catch_any_fault
    assert check_on(ASK, DRAWN).can_catch_any_fault


def test_only_the_scenario_that_failed_is_retried(monkeypatch):
    answers = {"in_order": ["good"], "drawn": ["bad", "good"]}
    ran = arenas(monkeypatch, lambda scenario, scale: run_of(scenario, said=answers[scenario.name].pop(0)))
    grade = grading.grade(SUBMISSION, exercise(check_on(ASK, DRAWN)), ONE_JOB)
    assert statuses(grade) == {"prints": "passed"}
    assert [name for name, _ in ran] == ["in_order", "drawn", "drawn"]


@pytest.mark.parametrize(
    ("least", "named"), [(1, "ask 2"), (3, "unplug, wait 2.5, ask 2"), (9, "ask 1, unplug, wait 2.5, ask 2")]
)
def test_a_failure_names_the_shortest_steps_that_show_it(monkeypatch, least, named):
    def answer(scenario, scale):
        steps = scenario.draw(0)["steps"]
        shown = scenario is DRAWN or len(steps) >= least
        return run_of(scenario, said="bad" if shown else "good")

    arenas(monkeypatch, answer)
    grade = grading.grade(SUBMISSION, exercise(check_on(DRAWN)), ONE_JOB)
    assert grade.checks[0].observed == f"bad; steps: {named}"


def test_steps_that_are_not_a_scenario_alone_are_not_shortened(monkeypatch):
    def answer(scenario, scale):
        if scenario is not DRAWN:
            raise grading.NotGraded("KeyError: 'goal'")
        return run_of(scenario, said="bad")

    arenas(monkeypatch, answer)
    grade = grading.grade(SUBMISSION, exercise(check_on(DRAWN)), ONE_JOB)
    assert statuses(grade) == {"prints": "failed"}


def test_with_an_arena_that_ends_early_no_check_passes(monkeypatch):
    arenas(monkeypatch, lambda scenario, scale: run_of(scenario, said="good", missing=("mark",)))
    grade = grading.grade(SUBMISSION, exercise(check_on(ASK)), ONE_JOB)
    assert grade.score == 0


def test_a_check_keeps_what_it_is_made_of_when_it_is_loaded_as_hidden():
    assert replace(check_on(DRAWN), hidden=True).can_catch_any_fault
