"""The table of clauses matches the recorded transcripts, and every clause is tested by a check or an obligation."""

import pytest

from audited.clause_table import clause_table, judged_by_clause
from autograder.engine.exercise import exercise_names
from ros_runtime.project import PROJECT

TABLES = PROJECT / "docs" / "clauses"


@pytest.mark.parametrize("exercise", exercise_names())
def test_the_table_matches_the_transcripts(exercise):
    table = (TABLES / f"{exercise}.md").read_text()
    assert table == clause_table(exercise), "record_transcripts.py writes it anew"


@pytest.mark.parametrize("exercise", exercise_names())
def test_every_clause_is_covered(exercise):
    assert not [number for number, judged in judged_by_clause(exercise).items() if not judged]
