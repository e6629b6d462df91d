"""A program is read as Python reads it, and a file that is not a program is named by its format."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from autograder.engine.submission import Submission, UnusableSubmission, read_submission

EXERCISE = "battery_service"
PROGRAM = 'GREETING = "¡Año!"\n\n\ndef main(args=None):\n    print(GREETING)\n'
COMMENTED = "".join(f"# {line}\n" for line in ["%%writefile battery_service.py", *PROGRAM.splitlines()])
NOTEBOOK = {"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}


@pytest.fixture
def read(tmp_path: Path):
    """Write a submission as battery_service.py, and read it."""

    def write_and_read(content: bytes | str) -> Submission:
        path = tmp_path / f"{EXERCISE}.py"
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return read_submission(path, EXERCISE)

    return write_and_read


@pytest.mark.parametrize(
    ("declaration", "encoding"),
    [
        ("", "utf-8-sig"),
        ("# -*- coding: latin-1 -*-\n", "latin-1"),
        ("#!/usr/bin/env python3\n# vim: set fileencoding=cp1252 :\n", "cp1252"),
    ],
)
def test_a_program_is_read_in_its_encoding_and_runs_in_it(read, declaration: str, encoding: str) -> None:
    source = declaration + PROGRAM
    submission = read(source.encode(encoding))

    assert submission.sources == {"battery_service.py": source}
    ran: dict[str, object] = {}
    exec(compile(submission.files["battery_service.py"], "battery_service.py", "exec"), ran)
    assert ran["GREETING"] == "¡Año!"


@pytest.mark.parametrize(
    ("content", "named"),
    [
        (PROGRAM.encode("utf-16"), "UTF-16 text, as PowerShell .* save it as UTF-8"),
        (PROGRAM.encode("utf-16-le"), "UTF-16 text, .* save it as UTF-8"),
        (PROGRAM.encode("latin-1"), r"cannot be read as Python .*UTF-8"),
        (b"\n\n\n" + PROGRAM.encode("latin-1"), r"is not UTF-8 text in line 4: save it as UTF-8"),
        ("# coding: klingon\n" + PROGRAM, "unknown encoding: klingon"),
        ("# coding: unicode_escape\n" + PROGRAM, "Python cannot read programs in unicode_escape"),
        (b"\xa7\r\r\n\0\0\0\0compiled", "is no text: hand in the text file"),
        (b"\x1f\x8b\x08", "is compressed by gzip"),
        (" \n", "is empty: save your work"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:4d\n", "only a git-lfs pointer"),
        (f"<<<<<<< HEAD\r\n{PROGRAM}=======\r\n>>>>>>> theirs\r\n", "has a merge conflict"),
        (b"PK\3\4", "a zip archive or an office document"),
        (json.dumps(NOTEBOOK), r"is a notebook: give it a name that ends in \.ipynb"),
        (
            "# In[1]:\nget_ipython().run_cell_magic('writefile', 'battery_service.py', 'import rclpy')\n",
            r"is a notebook that was exported as a script, .*hand in the notebook",
        ),
        (COMMENTED, "is a notebook that was exported as a script, with its program in comments"),
        ("%%writefile battery_service.py\n" + PROGRAM, "begins with %%writefile, .*delete that line"),
        ("<!DOCTYPE html>\n<html><body>", "is a web page"),
        (f"```python\n{PROGRAM}```\n", "begins with ```"),
    ],
)
def test_a_file_that_is_not_a_program_is_named_by_its_format(read, content: bytes | str, named: str) -> None:
    with pytest.raises(UnusableSubmission, match=rf"battery_service\.py .*{named}"):
        read(content)


@pytest.mark.parametrize("content", ["", '<<<<<<< HEAD\n{"cells": [\n=======\n{\n>>>>>>> theirs\n'])
def test_an_empty_or_half_merged_notebook_is_named_as_such(tmp_path: Path, content: str) -> None:
    (tmp_path / "work.ipynb").write_text(content)
    with pytest.raises(UnusableSubmission, match=r"work\.ipynb (is empty: save|has a merge conflict)"):
        read_submission(tmp_path / "work.ipynb", EXERCISE)


def test_a_program_with_the_magic_as_a_comment_is_accepted(read) -> None:
    assert read(f"# %%writefile battery_service.py\n{PROGRAM}").sources


def test_a_notebook_writes_utf_8_whatever_its_program_declares(tmp_path: Path) -> None:
    source = "# coding: latin-1\n" + PROGRAM
    cell = {"cell_type": "code", "id": "a", "metadata": {}, "outputs": [], "execution_count": None}
    cell["source"] = f"%%writefile battery_service.py\n{source}"
    path = tmp_path / "battery_service.ipynb"
    path.write_text(json.dumps(NOTEBOOK | {"cells": [cell]}))

    assert read_submission(path, EXERCISE).files == {"battery_service.py": source.encode()}
