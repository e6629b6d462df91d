"""Gaps: found in a cell, filled, written and checked at once."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest

import lab
from lab.learning import gap as gap_module
from lab.learning.gap import Gap, expect, find_gap, write_and_check
from lab.learning.gap_cells import fill, solution
from lab.learning.gap_check_helpers import advice_on, last_error, read_program, run_student_code
from lab.learning.progress_file import read_entries

PROGRAM = """def double(x):
    # YOUR CODE HERE: return twice x
    # (1 line)
    raise NotImplementedError


print(double(2))
"""
FOLDED = "<details><summary>Solution</summary>\n\n```python\nreturn 2 * x\n```\n\n</details>"


@pytest.fixture(autouse=True)
def double(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A gap in `double.py`, in a folder of its own."""

    def doubles() -> str:
        names: dict = {}
        exec(Path("double.py").read_text(), names)
        found = names["double"](4)
        expect(found == 8, seen=f"double(4) is {found}", expected="8", next="return twice x")
        return "double(4) is 8"

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(gap_module, "read_gaps", lambda chapter: (Gap("double.py", doubles),))


def test_the_solution_goes_into_the_gap_at_its_indentation() -> None:
    filled = fill(PROGRAM, solution(FOLDED))
    assert filled == "def double(x):\n    return 2 * x\n\n\nprint(double(2))\n"


def test_a_program_without_a_gap_and_a_cell_without_a_solution_are_reported() -> None:
    with pytest.raises(ValueError, match="expected one gap"):
        fill("print(1)\n", "x\n")
    with pytest.raises(ValueError, match="expected a folded solution"):
        solution("nothing folded")


def test_an_empty_gap_is_saved_and_says_where_to_write() -> None:
    with pytest.raises(
        lab.GapError, match=r"double\.py: nothing is written yet. Replace `raise NotImplementedError`"
    ):
        write_and_check("double.py", PROGRAM)
    assert Path("double.py").read_text() == f"# %%gap double.py\n{PROGRAM}"
    assert read_entries("gaps") == {}


def test_a_placeholder_is_recognized_without_its_comment() -> None:
    without = "".join(line for line in PROGRAM.splitlines(keepends=True) if "#" not in line)
    with pytest.raises(lab.GapError, match=r"nothing is written yet. Replace `raise NotImplementedError`"):
        write_and_check("double.py", without)


def test_an_exception_in_the_lines_is_located() -> None:
    Path("double.py").write_text("def double(x):\n    return twice\n", encoding="utf-8")
    double = read_program("double.py")["double"]
    with pytest.raises(lab.GapError, match=r"'twice' is not defined in line 2 \(`return twice`\)"):
        run_student_code(lambda: double(1), "double.py")


def test_for_wrong_lines_the_observation_and_the_next_step_are_printed(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with pytest.raises(lab.GapError) as raised:
        write_and_check("double.py", fill(PROGRAM, "return x\n"))
    assert str(raised.value) == (
        "double.py: not yet.\n  seen:     double(4) is 4\n  expected: 8\n  next:     return twice x"
    )
    assert read_entries("gaps") == {}


def test_lines_that_are_not_python_are_quoted_with_the_number_of_the_cells_line() -> None:
    with pytest.raises(lab.GapError, match=r"double\.py: .* in line 3: `return \(2 x`"):
        write_and_check("double.py", "def double(x):\n    return (2 x\n")


def test_while_a_check_runs_a_notice_says_what_is_tried_and_how_long_it_takes(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shown: list[str] = []

    @contextmanager
    def notice(text: str) -> Iterator[None]:
        shown.append(text)
        yield

    gap = Gap("double.py", lambda: "done", duration=8)
    monkeypatch.setattr(gap_module, "read_gaps", lambda chapter: (gap,))
    monkeypatch.setattr(gap_module, "notice", notice)
    write_and_check("double.py", fill(PROGRAM, "return 2 * x\n"))
    assert "double.py runs" in shown[0]
    assert "about 8 s" in shown[0]
    assert capsys.readouterr().out == "✓ double.py: done\n"


def test_correct_lines_are_confirmed_and_saved(capsys: pytest.CaptureFixture[str]) -> None:
    write_and_check(" double.py ", fill(PROGRAM, "return 2 * x\n"))
    assert capsys.readouterr().out.splitlines()[-1] == "✓ double.py: double(4) is 8"
    assert list(read_entries("gaps")) == ["double.py"]


def test_a_file_without_a_gap_is_reported() -> None:
    with pytest.raises(
        lab.LabError, match=r"no chapter has a gap in a file of this name; the files with gaps are double\.py"
    ):
        find_gap("another.py")


DEFINITION = "# YOUR CODE HERE: a speed, with its unit (1 line)\n...\n---\nbool success\n"


def test_a_definition_has_another_placeholder_and_is_not_compiled(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(gap_module, "read_gaps", lambda chapter: (Gap("Walk.srv", lambda: "a speed"),))
    with pytest.raises(lab.GapError, match=r"Walk\.srv: nothing is written yet. Replace `\.\.\.` by"):
        write_and_check("Walk.srv", DEFINITION)
    lines = solution(
        "<details><summary>Solution</summary>\n\n```text\nfloat64 speed  # m/s\n```\n\n</details>"
    )
    write_and_check("Walk.srv", fill(DEFINITION, lines))
    assert Path("Walk.srv").read_text() == "float64 speed  # m/s\n---\nbool success\n"
    assert capsys.readouterr().out == "✓ Walk.srv: a speed\n"


@pytest.mark.parametrize(
    ("cell", "printed"),
    [
        (
            "%%writefile a.py\nx = (1\n",
            "The file is written, but Python cannot run it. a.py: '(' was never closed in line 1: `x = (1`\n",
        ),
        ("%%writefile a.py\nx = 1\n", ""),
        ("%%writefile a.yaml\nx: [1\n", ""),
        ("x = 1", ""),
    ],
)
def test_a_syntax_error_in_a_written_file_is_named_at_once(
    cell: str, printed: str, capsys: pytest.CaptureFixture[str]
) -> None:
    gap_module._name_syntax_error(SimpleNamespace(info=SimpleNamespace(raw_cell=cell)))
    assert capsys.readouterr().out == printed


SPUN = """Traceback (most recent call last):
  File "/course/status.py", line 40, in main
    rclpy.spin(node)
  File "/x/rclpy/__init__.py", line 247, in spin
    executor.spin_once()
"""


@pytest.mark.parametrize(
    ("rest", "error", "advice"),
    [
        (
            '  File "/x/rclpy/service.py", line 75, in send_response\n    raise TypeError()\nTypeError\n',
            "TypeError",
            "Your service callback returned nothing, or something other than the response.",
        ),
        (
            '  File "/course/status.py", line 21, in on_request\n    x = 1 + None\nTypeError: unsupported operand\n',
            "TypeError: unsupported operand in line 21 (`x = 1 + None`)",
            "fix the error that is named here",
        ),
    ],
)
def test_an_error_is_quoted_with_the_line_that_raised_it_and_its_own_advice(
    rest: str, error: str, advice: str
) -> None:
    assert last_error(SPUN + rest, "status.py") == error
    assert advice_on(SPUN + rest, error).startswith(advice)
