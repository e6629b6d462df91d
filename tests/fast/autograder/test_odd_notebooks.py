"""Self-checks and grading read a notebook's cells as IPython does, whatever else is in the file."""

from __future__ import annotations

import json
import warnings
from itertools import product

import nbformat
import pytest
from IPython.core.interactiveshell import InteractiveShell
from traitlets.config import Config

from autograder.classroom.batch.collection import collect
from autograder.classroom.nbgrader_bridge.rebuild_submission import rebuild_submission
from autograder.classroom.nbgrader_bridge.source_notebook import read_source
from autograder.engine.exercise import UnusableExercise, file_names
from autograder.engine.notebook import written_by
from autograder.engine.submission import UnusableSubmission, read_submission
from ros_runtime.project import PROJECT

NAME = "battery_service"
FIRST, SECOND = "import rclpy\n", "def main():\n    pass\n"
MAGICS = {
    "plain": [f"%%writefile {NAME}.py\n{FIRST}{SECOND}"],
    "without an end of line": [f"%%writefile {NAME}.py\n{FIRST}{SECOND}".rstrip()],
    "the last counts": [f"%%writefile {NAME}.py\nold", f"%%writefile {NAME}.py\n{FIRST}{SECOND}"],
    "appended": [f"%%writefile {NAME}.py\n{FIRST}", f"%%writefile -a {NAME}.py\n{SECOND}"],
    "appended by a long option": [f"%%file {NAME}.py\n{FIRST}", f"%%writefile {NAME}.py --append\n{SECOND}"],
    "an alias": [f"%%file {NAME}.py\n{FIRST}{SECOND}"],
    "an alias of their own": [
        '%alias_magic w writefile -p "-a"',
        f"%%w {NAME}.py\n{FIRST}",
        f"%%w {NAME}.py\n{SECOND}",
    ],
    "quotes": [f'%%writefile "{NAME}.py"\n{FIRST}{SECOND}'],
    "below this folder": [f"%%writefile ./{NAME}.py\n{FIRST}{SECOND}"],
    "spaces": [f"\n\n%%writefile   {NAME}.py  \n{FIRST}{SECOND}"],
    "indented": [
        "".join(f"    {line}\n" for line in [f"%%writefile {NAME}.py", "import rclpy", "def main():"])
    ],
    "tabs": [f"\t%%writefile {NAME}.py\n\tx = 1\n"],
    "prompts": [f">>> %%writefile {NAME}.py\n>>> x = 1\n"],
    "numbered prompts": [f"In [1]: %%writefile {NAME}.py\n   ...: x = 1\n"],
    "inside others": [f"%%capture out\n%%timeit -n1 -r1\n%%time\n%%writefile {NAME}.py\n{FIRST}{SECOND}"],
    "as nbconvert says it": [f"get_ipython().run_cell_magic('writefile', '{NAME}.py', 'x = 1\\n')"],
    "variables": [
        f"NAME = '{NAME}'\nFILE: str = '{NAME}.py'",
        f"%%writefile {{NAME}}.py\n{FIRST}",
        f"%%writefile -a $FILE\n{SECOND}",
    ],
    "escapes": [f'%%writefile {NAME}.py\nprint("\\d ü 😀 {{x}} $x %time")\n'],
    "beside what fails": [
        "1 +",
        "!true",
        "%no_such_magic",
        f"%%writefile {NAME}.py\nx = 1\n",
        "raise ValueError",
    ],
}
WRITES_NOTHING = {
    "too many names": (
        [f"%%writefile {NAME}.py # mine\nx"],
        "Jupyter refuses .* unrecognized arguments: # mine",
    ),
    "no name": (["%%writefile\nx"], "the following arguments are required: filename"),
    "no cell": (
        [f"%%writefile {NAME}.py"],
        "no code cell that begins with '%%writefile battery_service.py'$",
    ),
    "a tab": (
        [f"%%writefile\t{NAME}.py\nx"],
        "'%%writefile.tbattery_service.py' has no space behind %%writefile",
    ),
    "below a comment": ([f"# mine\n%%writefile {NAME}.py\nx"], "is not the first line of its cell"),
}
UNKNOWN = ["import os", "%%writefile {os.path.join('.', 'x')}.py\nx", "%%writefile $NAME.py\nx"]


@pytest.fixture(scope="module")
def shell():
    return InteractiveShell(config=Config({"HistoryManager": {"enabled": False}}))


@pytest.mark.parametrize("cells", [*MAGICS.values(), *(cells for cells, _ in WRITES_NOTHING.values())])
def test_cells_write_the_same_files_as_in_ipython(tmp_path, monkeypatch, shell, cells):
    monkeypatch.chdir(tmp_path)
    for cell in cells:
        shell.run_cell(cell)
    assert written_by(cells).files == {path.name: path.read_text() for path in tmp_path.iterdir()}


def file_of(cells, version, minor, ids, extra):
    """Return the bytes of a notebook's file, as tools of several years have written them."""
    made = [
        {
            "cell_type": "code",
            "metadata": {},
            "execution_count": 1,
            "outputs": extra["outputs"],
            "source": cell,
        }
        for cell in cells
    ]
    made.insert(0, {"cell_type": "markdown", "metadata": {}, "source": ["# Task\n", "text"]})
    for number, cell in enumerate(made):
        if ids == "twice":
            cell["id"] = "same"
        elif ids == "own":
            cell["id"] = f"cell-{number}"
        if extra["lists"]:
            cell["source"] = "".join(cell["source"]).splitlines(keepends=True)
    made += extra["cells"]
    whole = {"metadata": {}, "nbformat": version, "nbformat_minor": minor}
    if version == 3:
        for cell in made:
            if isinstance(cell, dict) and cell["cell_type"] == "code" and "source" in cell:
                cell["input"] = cell.pop("source")
        whole["worksheets"] = [{"cells": made, "metadata": {}}]
    else:
        whole["cells"] = made
    text = json.dumps(whole, indent=extra["indent"]).replace("\n", extra["newline"])
    return text.encode(extra["encoding"])


USUAL = {"outputs": [], "lists": True, "cells": [], "indent": 1, "newline": "\n", "encoding": "utf-8"}
EXTRAS = {
    "usual": {},
    "one string a cell": {"lists": False},
    "a BOM and CRLF": {"encoding": "utf-8-sig", "newline": "\r\n"},
    "one line": {"indent": None},
    "broken outputs": {"outputs": [None, {"output_type": "stream"}]},
    "large outputs": {"outputs": [{"output_type": "stream", "name": "stdout", "text": "x" * 200_000}]},
    "broken cells": {"cells": [7, {"cell_type": "code"}, {"cell_type": "raw", "source": None}]},
}
FORMATS = [(3, 0, None), *((4, minor, None) for minor in range(6)), (4, 5, "twice"), (4, 5, "own")]


@pytest.mark.parametrize(("form", "extra"), list(product(FORMATS, EXTRAS)), ids=str)
def test_check_and_grade_read_the_same_of_every_file_and_say_nothing(tmp_path, capfd, caplog, form, extra):
    file = tmp_path / f"anna/{NAME}/{NAME}.ipynb"
    file.parent.mkdir(parents=True)
    file.write_bytes(file_of(MAGICS["appended"], *form, USUAL | EXTRAS[extra]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        checked = read_submission(file, NAME).sources
        (work,) = collect(tmp_path).works
        graded = work.read().sources
    assert checked == graded == {f"{NAME}.py": FIRST + SECOND}
    assert (capfd.readouterr(), caplog.records) == (("", ""), [])


def test_nbgrader_gets_a_valid_notebook_of_what_was_read():
    release = nbformat.read(PROJECT / f"exercises/{NAME}/{NAME}.ipynb", as_version=4)
    nbformat.validate(rebuild_submission(release, file_names(NAME), {f"{NAME}.py": FIRST + SECOND}))


@pytest.mark.parametrize(("cells", "reason"), [*WRITES_NOTHING.values(), (UNKNOWN, "from a variable")])
def test_a_cell_that_writes_nothing_in_jupyter_is_named_with_the_reason(tmp_path, cells, reason):
    file = tmp_path / "work.ipynb"
    file.write_bytes(file_of(cells, 4, 5, "own", USUAL))
    with pytest.raises(UnusableSubmission, match=reason):
        read_submission(file, NAME)


def test_a_lone_surrogate_is_named_with_its_line(tmp_path):
    file = tmp_path / "work.ipynb"
    file.write_bytes(file_of([f"%%writefile {NAME}.py\nx = 1\n# \ud83d\n"], 4, 5, "own", USUAL))
    with pytest.raises(
        UnusableSubmission, match=r"line 2 of battery_service\.py holds half a character, \\ud83d"
    ):
        read_submission(file, NAME)


def test_outputs_beyond_all_bounds_are_to_be_cleared(tmp_path):
    file = tmp_path / "work.ipynb"
    with file.open("wb") as sparse:
        sparse.truncate(54_000_000)
    with pytest.raises(
        UnusableSubmission, match="54,000,000 bytes; at most 50,000,000 are read; clear its outputs"
    ):
        read_submission(file, NAME)


@pytest.mark.parametrize("form", FORMATS, ids=str)
def test_an_authors_notebook_of_any_format_becomes_a_valid_one_the_same_each_time(tmp_path, capfd, form):
    file = tmp_path / "own.ipynb"
    file.write_bytes(file_of(MAGICS["appended"], *form, USUAL | EXTRAS["a BOM and CRLF"]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read = read_source(file)
        nbformat.validate(read)
    assert (read.nbformat, read.nbformat_minor) == (4, 5)
    assert read == read_source(file)
    assert [cell.source for cell in read.cells if cell.cell_type == "code"] == MAGICS["appended"]
    assert capfd.readouterr() == ("", "")


def test_an_authors_file_that_is_not_a_notebook_is_named(tmp_path):
    (tmp_path / "own.ipynb").write_text("{}")
    with pytest.raises(UnusableExercise, match=r"own\.ipynb is not a notebook"):
        read_source(tmp_path / "own.ipynb")
