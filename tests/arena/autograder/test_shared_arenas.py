"""Arenas of an audit: the faulty submissions of an exercise share them, and no arena outlives the audit."""

import os

import pytest

from autograder.classroom.audit.audit_record import AuditRecord
from autograder.classroom.audit.known_submission import known_submissions
from autograder.classroom.audit.run import audit, audit_one
from autograder.engine.exercise import load_exercise
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.isolation.availability import available_isolation
from autograder.isolation.process_tree import descendants

pytestmark = pytest.mark.skipif(
    not available_isolation().trusted, reason=f"no namespaces here: {available_isolation().reason}"
)
EXERCISE = load_exercise("patterns", hidden=True)
FAULTY = known_submissions("patterns", only="faulty/*")[:2]
OTHERS = [known_submissions("patterns", only=f"{kind}/*")[0] for kind in ("correct", "hostile")]


def audited(submissions, grade_one):
    record = AuditRecord(None, isolation=available_isolation())
    return audit(submissions, EXERCISE, record, lambda run, earlier: None, jobs=1, grade_one=grade_one)


def test_only_faulty_submissions_share_arenas_and_none_is_left_open():
    before, lent = set(descendants(os.getpid())), {}

    def grade_one(known, *options, arenas=None, **more):
        lent[known] = arenas
        run = audit_one(known, *options, arenas=arenas, **more)
        assert run.surprises() == []
        return run

    audited([*OTHERS, *FAULTY], grade_one)
    assert [lent[known] for known in OTHERS] == [None, None]
    assert lent[FAULTY[0]] is lent[FAULTY[1]] is not None
    assert set(descendants(os.getpid())) <= before


def test_a_grading_leaves_the_arenas_open_that_it_was_given():
    with SubmissionArenas(EXERCISE.scenario_file) as arenas:
        opened = []
        for known in FAULTY:
            assert audit_one(known, EXERCISE, arenas=arenas).surprises() == []
            with arenas.one() as arena:
                opened.append(arena)
        assert opened[0] is opened[1]


def test_an_audit_that_ends_early_leaves_no_arena_open():
    before = set(descendants(os.getpid()))

    def grade_one(known, *options, arenas=None, **more):
        audit_one(known, *options, arenas=arenas, **more)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        audited(FAULTY, grade_one)
    assert set(descendants(os.getpid())) <= before
