"""How a student's notebook shows a verdict."""

from __future__ import annotations

import re

import nbformat
import pytest
from made_up_grades import FAILED, grade_of
from nbclient import NotebookClient

from autograder.self_check import SelfCheck


def test_a_verdict_cell_repeats_what_the_self_check_found(capsys):
    checked = SelfCheck(grade_of("you", follows_the_battery=FAILED))
    checked.show("follows_the_battery")
    shown = capsys.readouterr().out
    for words in ("what should be", "what was", "what to do", "0/1"):
        assert words in shown


SHOW_A_LONG_VERDICT = """
from autograder.self_check import NOTEBOOK_WIDTH, SelfCheck
from autograder.engine.verdict import CheckVerdict, Grade
failed = CheckVerdict("a", "A title", "failed", 0, 1, expected="more", observed="less", help="do this " * 30)
SelfCheck(Grade("battery_service", "you", "namespaces", [failed])).show("a")
print(NOTEBOOK_WIDTH)
"""


def test_a_verdict_in_a_notebook_is_plain_text_in_colour_that_wraps_in_its_column():
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(SHOW_A_LONG_VERDICT)])
    NotebookClient(notebook).execute()
    outputs = notebook.cells[0].outputs
    assert {output.output_type for output in outputs} == {"stream"}  # JupyterLab shows those as one block
    text = "".join(output.text for output in outputs)
    assert "\x1b[1;31m✗" in text
    *lines, width = re.sub(r"\x1b\[[0-9;]*m", "", text).splitlines()
    assert max(map(len, lines)) <= int(width)
    column = lines[3].index("do this")
    assert all(line[:column].isspace() and line[column:].startswith(("do", "this")) for line in lines[4:])


def test_a_verdict_cell_with_an_unknown_check_names_those_there_are():
    with pytest.raises(KeyError, match="server_appears"):
        SelfCheck(grade_of("you")).show("servr_appears")
