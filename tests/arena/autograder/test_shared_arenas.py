"""Arenas of an audit: the faulty submissions of an exercise share them, and all are closed after the last one."""

import os

import pytest

from autograder.classroom.audit.known_submission import known_submissions
from autograder.classroom.audit.run import SharedArenas, audit_one
from autograder.engine.exercise import load_exercise
from autograder.isolation.availability import available_isolation
from autograder.isolation.process_tree import descendants

pytestmark = pytest.mark.skipif(
    not available_isolation().trusted, reason=f"no namespaces here: {available_isolation().reason}"
)
EXERCISE = load_exercise("patterns", hidden=True)
FAULTY = known_submissions("patterns", only="faulty/*")[:2]
OTHERS = [known_submissions("patterns", only=f"{kind}/*")[0] for kind in ("correct", "hostile")]


def graded_in(shared, known):
    """Grade it and return the arena that is open afterwards."""
    with shared.lent_to(known, EXERCISE) as arenas:
        assert audit_one(known, EXERCISE, arenas=arenas).surprises() == []
        with arenas.one() as arena:
            return arena


def test_faulty_submissions_share_an_arena_which_is_closed_after_the_last():
    before = set(descendants(os.getpid()))
    with SharedArenas([*OTHERS, *FAULTY]) as shared:
        first = graded_in(shared, FAULTY[0])
        assert set(descendants(os.getpid())) > before
        assert graded_in(shared, FAULTY[1]) is first
        assert set(descendants(os.getpid())) <= before


def test_a_correct_and_a_hostile_submission_have_arenas_of_their_own():
    with SharedArenas([*OTHERS, *FAULTY]) as shared:
        for known in OTHERS:
            with shared.lent_to(known, EXERCISE) as arenas:
                assert arenas is None


def test_an_audit_that_ends_early_leaves_no_arena_open():
    before = set(descendants(os.getpid()))
    with SharedArenas(FAULTY) as shared:
        graded_in(shared, FAULTY[0])
    assert set(descendants(os.getpid())) <= before
