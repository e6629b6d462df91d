"""Every exercise has mutants, of which a sample loses points (`course audit --generated` grades more of them)."""

import pytest
from rich.console import Console

from autograder.classroom.audit.audit_record import AuditRecord
from autograder.classroom.audit.generated.mutant import mutants_of_exercise
from autograder.classroom.audit.generated.run import audit_generated, equivalents, is_one_of, selected
from autograder.engine.exercise import exercise_names, load_exercise
from autograder.isolation.availability import available_isolation

SAMPLE = 5  # mutants of an exercise, of five operators
FEW = {"interfaces": 0, "patterns": 0}  # definitions are not programs; answers are words


@pytest.mark.parametrize("name", exercise_names())
def test_every_exercise_yields_enough_mutants_with_names_of_their_own_and_its_equivalents(name):
    made = mutants_of_exercise(name)
    assert len(made) >= FEW.get(name, 60)
    assert len({mutant.name for mutant in made}) == len(made)
    assert len(selected(made, 60)) == min(60, len(made))
    gone = [one for one in equivalents(name) if not any(is_one_of(one, mutant) for mutant in made)]
    assert gone == []


@pytest.mark.parametrize("exercise", ["battery_service", "compute_ik"])
def test_generated_faults_lose_points(exercise):
    if not available_isolation().trusted:
        pytest.skip(f"hidden checks need isolated arenas: {available_isolation().reason}")
    record = AuditRecord(None, isolation=available_isolation())
    judged = audit_generated(load_exercise(exercise, hidden=True), record, Console(quiet=True), number=SAMPLE)
    assert len(judged) == SAMPLE
    assert [one.mutant.name for one in judged if not one.noticed_by] == []
