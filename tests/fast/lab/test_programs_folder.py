"""A notebook's programs are in a folder of their own, and programs of an earlier version stay in place."""

from __future__ import annotations

from pathlib import Path

import pytest

import lab
from lab.learning.progress_file import read_entries, store_entry
from lab.running import programs_folder


@pytest.fixture
def notebooks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a student's notebooks, in which a kernel starts."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(programs_folder, "_notebooks", Path())
    return tmp_path


def test_each_notebook_writes_its_own_file_of_a_name(notebooks: Path) -> None:
    for chapter in ("02_services", "03_clients_that_survive", "02_services"):
        lab.keep_programs_in(f"programs/{chapter}")
        with Path("where_am_i.py").open("a") as file:
            file.write(f"# {chapter}\n")
    written = {path.parent.name: path.read_text() for path in notebooks.rglob("*.py")}
    assert written == {
        "02_services": "# 02_services\n# 02_services\n",
        "03_clients_that_survive": "# 03_clients_that_survive\n",
    }


def test_the_path_for_a_terminal_is_printed(
    notebooks: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(programs_folder, "WORK", notebooks.parent)
    lab.keep_programs_in("programs/02_services")
    expected = f"The programs of this notebook are in {notebooks.name}/programs/02_services\n"
    assert capsys.readouterr().out == expected


def test_programs_beside_the_notebook_are_kept_named_and_not_used(
    notebooks: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("a", "b", "c", "d"):
        Path(f"{name}.py").write_text("mine\n")
    lab.keep_programs_in("programs/02_services")
    assert capsys.readouterr().out == (
        "The programs of this notebook are in programs/02_services\n"
        "These programs beside the notebook are no longer used: a.py, b.py, c.py, …\n"
    )
    with pytest.raises(lab.LabError, match=r"there is no file a\.py in .*02_services; run the cell"):
        lab.run_program("a.py")
    assert (notebooks / "a.py").read_text() == "mine\n"


def test_progress_stays_beside_the_notebooks(notebooks: Path) -> None:
    store_entry("predictions", "before", "one")
    lab.keep_programs_in("programs/02_services")
    store_entry("predictions", "after", "two")
    assert (
        read_entries("predictions", notebooks)
        == read_entries("predictions")
        == {"before": "one", "after": "two"}
    )
    assert not list((notebooks / "programs").rglob(".progress.json"))
