"""The clauses of a statement are read from its notebook, and a hidden check names the clause that it tests."""

import json

from autograder.engine.exercise import clauses_in, clauses_in_words, load_exercise

TASK = """## The task

| File | `x.py` |

1. The first, `code` and all,
   goes on here.
2. The second.

Something else.

3. The third.
"""


def test_clauses_are_the_numbered_items_of_the_task(tmp_path):
    notebook = tmp_path / "x.ipynb"
    other = {"id": "stretch", "source": ["1. Not this one."]}
    notebook.write_text(json.dumps({"cells": [other, {"id": "task", "source": TASK.splitlines(True)}]}))
    clauses = clauses_in(notebook)
    assert clauses == {1: "The first, code and all, goes on here.", 2: "The second.", 3: "The third."}
    assert clauses_in_words(clauses, [2]) == "clause 2, “The second.”"
    assert clauses_in_words(clauses, [2, 3]) == "clauses 2 (“The second.”), 3 (“The third.”)"
    assert clauses_in_words(clauses, []) == ""


def test_a_copy_without_the_notebook_has_no_clauses(tmp_path):
    assert clauses_in(tmp_path / "none.ipynb") == {}


def test_a_loaded_check_quotes_its_clause_from_the_statement():
    checks = {check.id: check for check in load_exercise("battery_service", hidden=True).checks}
    assert checks["answers_every_request"].promise.startswith("clause 4, “Every request is answered at once")
