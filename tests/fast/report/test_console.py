"""Lines that are printed for students are broken between words in a terminal, and nowhere else."""

from __future__ import annotations

import io

import pytest
from rich.table import Table
from rich.text import Text

from autograder.report.console import BAD, GOOD, NOTICE, OTHER, LineConsole, wrapped

PATH = "/home/ada/" + "humanoid-course/" * 30 + "hand_in"


@pytest.mark.parametrize("line", [f"written to {PATH}, unchanged", Text(f"written to {PATH}, unchanged")])
def test_no_line_is_broken_in_a_file(line: str | Text) -> None:
    console = LineConsole(file=io.StringIO(), width=80)
    console.print(line)
    assert console.file.getvalue() == f"written to {PATH}, unchanged\n"  # type: ignore[attr-defined]


def test_a_table_has_the_width_of_the_console() -> None:
    console = LineConsole(file=io.StringIO(), width=80)
    table = Table.grid()
    table.add_row("word " * 40)
    console.print(table)
    lines = console.file.getvalue().splitlines()  # type: ignore[attr-defined]
    assert max(map(len, lines)) <= 80
    assert [line for line in lines if line.endswith(" ")] == []


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def printed(*objects: str | Text, **settings: object) -> str:
    console = LineConsole(file=Terminal(), width=30, color_system=None, legacy_windows=False)
    console.print(*objects, **settings)
    return console.file.getvalue()  # type: ignore[attr-defined]


@pytest.mark.parametrize("kind", [str, Text])
def test_a_terminal_gets_lines_of_whole_words_with_their_indent(kind: type) -> None:
    line = "  5 hidden checks run when your work is graded.\n\nNext: submit [it]"
    assert printed(kind(line), markup=False) == (
        "  5 hidden checks run when\n  your work is graded.\n\nNext: submit [it]\n"
    )


def test_a_cell_gets_whole_lines_because_its_page_breaks_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("JPY_PARENT_PID", "1")
    assert printed(f"written to {PATH}, unchanged") == f"written to {PATH}, unchanged\n"


def test_a_path_is_not_broken_so_that_it_can_be_copied() -> None:
    assert printed(f"written to {PATH}, unchanged", markup=False) == f"written to\n{PATH},\nunchanged\n"


def test_a_broken_line_keeps_its_colours() -> None:
    text = Text.assemble(("✓ ", GOOD), "the node ends within a second of Ctrl-C", ("  2/2", "dim"))
    broken = wrapped(text, 20)
    assert broken.plain == "✓ the node ends\nwithin a second of\nCtrl-C  2/2"
    assert [str(span.style) for span in broken.spans] == [GOOD, "dim"]


@pytest.mark.parametrize("colour", [GOOD, BAD, NOTICE, OTHER])
def test_no_colour_vanishes_on_white_or_on_black(colour: str) -> None:
    assert not {"yellow", "cyan", "magenta", "white", "black"} & set(colour.split())
    assert colour not in ("red", "blue")
