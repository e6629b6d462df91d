"""Lines that are printed for students are wrapped by the terminal or the page, not by the course."""

from __future__ import annotations

import io

import pytest
from rich.table import Table
from rich.text import Text

from autograder.report.console import LineConsole

PATH = "/home/ada/" + "humanoid-course/" * 30 + "hand_in"


@pytest.mark.parametrize("line", [f"written to {PATH}, unchanged", Text(f"written to {PATH}, unchanged")])
def test_no_line_is_broken(line: str | Text) -> None:
    console = LineConsole(file=io.StringIO(), width=80)
    console.print(line)
    assert console.file.getvalue() == f"written to {PATH}, unchanged\n"  # type: ignore[attr-defined]


def test_a_table_has_the_width_of_the_console() -> None:
    console = LineConsole(file=io.StringIO(), width=80)
    table = Table.grid()
    table.add_row("word " * 40)
    console.print(table)
    assert max(map(len, console.file.getvalue().splitlines())) <= 80  # type: ignore[attr-defined]
