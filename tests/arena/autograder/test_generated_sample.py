"""A sample of the faults that are made of correct submissions loses points (`course audit --generated` grades more)."""

import pytest

from autograder.audit.audit_record import AuditRecord
from autograder.audit.generated.run import audit_generated
from autograder.engine.exercise import load_exercise
from autograder.isolation.availability import available_isolation

SAMPLE = 5  # mutants of an exercise, of five operators


@pytest.mark.parametrize("exercise", ["battery_service", "compute_ik"])
def test_generated_faults_lose_points(exercise):
    if not available_isolation().trusted:
        pytest.skip(f"hidden checks need isolated arenas: {available_isolation().reason}")
    record = AuditRecord(None, isolation=available_isolation())
    audited = audit_generated(load_exercise(exercise, hidden=True), record, number=SAMPLE)
    assert len(audited.judged) == SAMPLE
    assert not [judged.mutant.name for judged in audited.judged if not judged.lost_points]
