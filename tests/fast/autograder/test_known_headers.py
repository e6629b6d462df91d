"""The headers of the known submissions: they name existing checks, and each check has a fault that only it finds."""

import pytest

from audited.proof import enough_to_prove
from autograder.classroom.audit.known_submission import known_submissions, require_known_checks
from autograder.engine.exercise import exercise_names, load_exercise

EXERCISES = {name: load_exercise(name, hidden=True) for name in exercise_names()}
KNOWN = {name: known_submissions(name) for name in EXERCISES}

# Why they are kept: solutions/README.md
WITHOUT_A_KILLER = {"cancellable_walk": {"obeys_a_stranger"}}
NEVER_ALONE = {
    "cancellable_walk": {
        "feedback_ends_with_the_goal",
        "stops_in_any_phase_of_the_gait",
        "stops_when_canceled",
        "cancels_at_the_start",
        "survives_two_cancels",
    },
    "patterns": {"answers_everything"},
    "robot_controller": {"copes_with_two_servers", "prints_any_status"},
}


@pytest.mark.parametrize("name", EXERCISES)
def test_headers_name_checks_that_exist(name):
    for known in KNOWN[name]:
        require_known_checks(known, [check.id for check in EXERCISES[name].checks])


@pytest.mark.parametrize("name", EXERCISES)
def test_those_that_ci_grades_prove_as_much_as_all(name):
    graded = enough_to_prove(KNOWN[name])
    named, named_by_all = (
        {check for known in of for check in known.caught_by} for of in (graded, KNOWN[name])
    )
    assert named == named_by_all
    assert {known.kind for known in graded} == {known.kind for known in KNOWN[name]}


@pytest.mark.parametrize("name", EXERCISES)
def test_every_check_is_named_by_a_faulty_submission(name):
    named = {check for known in KNOWN[name] for check in known.caught_by}
    unnamed = {check.id for check in EXERCISES[name].checks} - named
    assert unnamed == WITHOUT_A_KILLER.get(name, set())


@pytest.mark.parametrize("name", EXERCISES)
def test_every_check_has_a_fault_that_it_alone_catches(name):
    """So each check tests something that no other does; checks that depend on it are not run if it fails."""
    faulty = [known for known in KNOWN[name] if known.kind == "faulty"]
    alone = {known.caught_by[0] for known in faulty if len(known.caught_by) == 1 and not known.also_fails}
    never = {check.id for check in EXERCISES[name].checks} - alone
    assert never == WITHOUT_A_KILLER.get(name, set()) | NEVER_ALONE.get(name, set())
