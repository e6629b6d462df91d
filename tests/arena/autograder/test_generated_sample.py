"""A sample of mutants of correct submissions loses points (`course audit --generated` grades more of them)."""

import pytest
from rich.console import Console

from autograder.classroom.audit.audit_record import AuditRecord
from autograder.classroom.audit.generated.run import audit_generated
from autograder.engine.exercise import load_exercise
from autograder.isolation.availability import available_isolation

SAMPLE = 5  # mutants of an exercise, of five operators


@pytest.mark.parametrize("exercise", ["battery_service", "compute_ik"])
def test_generated_faults_lose_points(exercise):
    if not available_isolation().trusted:
        pytest.skip(f"hidden checks need isolated arenas: {available_isolation().reason}")
    record = AuditRecord(None, isolation=available_isolation())
    judged = audit_generated(load_exercise(exercise, hidden=True), record, Console(quiet=True), number=SAMPLE)
    assert len(judged) == SAMPLE
    assert [one.mutant.name for one in judged if not one.noticed_by] == []
