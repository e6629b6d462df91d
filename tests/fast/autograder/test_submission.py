import json

import nbformat
import pytest

from autograder.engine.submission import MAX_BYTES, UnusableSubmission, read_submission


def notebook(*sources):
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    return nbformat.writes(nbformat.v4.new_notebook(cells=cells))


def test_a_python_file_is_taken_as_it_is(tmp_path):
    file = tmp_path / "battery_service.py"
    file.write_text("print('π')\n")
    assert read_submission(file, "battery_service").files == {"battery_service.py": "print('π')\n".encode()}


def test_of_a_notebook_the_last_cell_that_writes_the_file_counts_and_nothing_is_run(tmp_path):
    file = tmp_path / "work.ipynb"
    file.write_text(
        notebook(
            "raise SystemExit",
            "%%writefile battery_service.py\nold",
            "%%writefile other.py\nno",
            "%%writefile battery_service.py\nnew",
        )
    )
    assert read_submission(file, "battery_service").sources == {"battery_service.py": "new\n"}


def test_several_files_are_read_from_a_notebook_or_a_folder(tmp_path):
    written = {"GetBatteryStatus.srv": "---\nbool available\n", "NavigateToPose.action": "---\n---\n"}
    file = tmp_path / "work.ipynb"
    file.write_text(notebook(*(f"%%writefile {name}\n{text}" for name, text in written.items())))
    for name, text in written.items():
        (tmp_path / name).write_text(text)
    assert read_submission(file, "interfaces").sources == written
    assert read_submission(tmp_path, "interfaces").sources == written


def test_one_of_several_files_may_be_missing_but_not_all(tmp_path):
    (tmp_path / "GetBatteryStatus.srv").write_text("---\n")
    assert list(read_submission(tmp_path, "interfaces").sources) == ["GetBatteryStatus.srv"]
    (tmp_path / "GetBatteryStatus.srv").unlink()
    with pytest.raises(UnusableSubmission, match=r"none of GetBatteryStatus\.srv, NavigateToPose\.action"):
        read_submission(tmp_path, "interfaces")


def test_for_one_of_several_files_alone_the_error_names_the_expected_argument(tmp_path):
    file = tmp_path / "GetBatteryStatus.srv"
    file.write_text("---\n")
    with pytest.raises(UnusableSubmission, match="give the folder they lie in"):
        read_submission(file, "interfaces")


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("work.ipynb", notebook("x = 1"), "no code cell that begins with '%%writefile battery_service.py'"),
        ("work.ipynb", "not JSON", "is not a notebook"),
        ("work.ipynb", json.dumps({"cells": 3}), "is not a notebook|no code cell"),
        ("work.py", "x" * (MAX_BYTES + 1), "at most"),
    ],
)
def test_what_cannot_be_read_is_refused_with_the_reason(tmp_path, name, content, reason):
    file = tmp_path / name
    file.write_text(content)
    with pytest.raises(UnusableSubmission, match=reason):
        read_submission(file, "battery_service")


def test_text_in_another_encoding_is_refused(tmp_path):
    file = tmp_path / "work.py"
    file.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(UnusableSubmission, match="UTF-8"):
        read_submission(file, "battery_service")


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(UnusableSubmission, match="there is no file"):
        read_submission(tmp_path / "nowhere.py", "battery_service")


def test_a_program_that_was_not_written_yet_names_its_cell(tmp_path):
    with pytest.raises(UnusableSubmission, match="run the cell that begins %%writefile"):
        read_submission(tmp_path / "battery_service.py", "battery_service")


def test_a_reason_quotes_little_of_a_notebook(tmp_path):
    file = tmp_path / "work.ipynb"
    file.write_text(notebook(f"%%writefile {'x' * 2_000_000}\npass"))
    with pytest.raises(UnusableSubmission, match="its arguments have 2,000,000 characters") as caught:
        read_submission(file, "battery_service")
    assert len(str(caught.value)) < 2000


def test_a_file_that_cannot_be_a_program_is_refused_before_anything_runs(tmp_path):
    (tmp_path / "README.md").write_text("# Notes\n")
    with pytest.raises(
        UnusableSubmission, match=r"README\.md is no program; give walk_to\.py or walk_to\.ipynb"
    ):
        read_submission(tmp_path / "README.md", "walk_to")
