"""The headers of the submissions whose verdict is known name checks, and every check is named by a fault."""

import pytest

from autograder.audit.known_submission import known_submissions, require_known_checks
from autograder.engine.exercise import exercise_names, load_exercise

EXERCISES = {name: load_exercise(name, hidden=True) for name in exercise_names()}
KNOWN = [known for name in EXERCISES for known in known_submissions(name)]

# Why they are kept: solutions/README.md
WITHOUT_A_KILLER = {"cancellable_walk": {"obeys_a_stranger"}}


@pytest.mark.parametrize("known", KNOWN, ids=lambda known: f"{known.exercise}/{known.name}")
def test_header_names_checks_that_exist(known):
    require_known_checks(known, [check.id for check in EXERCISES[known.exercise].checks])


@pytest.mark.parametrize("name", EXERCISES)
def test_every_check_is_named_by_a_faulty_submission(name):
    named = {check for known in KNOWN if known.exercise == name for check in known.caught_by}
    unnamed = {check.id for check in EXERCISES[name].checks} - named
    assert unnamed == WITHOUT_A_KILLER.get(name, set())
