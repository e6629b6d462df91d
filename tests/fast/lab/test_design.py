"""A notebook draws a design and lists its missing facts, without grading it."""

from __future__ import annotations

from pathlib import Path

import pytest

import lab
from lab.learning import design as module

HALF = """
camera -> finder : topic sensor_msgs/msg/Image
    qos: best effort
    rate: 15 Hz
"""
WHOLE = HALF + "    failure: after 0.5 s it says so\n    safety: it moves nothing\n"


@pytest.fixture
def kept(monkeypatch: pytest.MonkeyPatch) -> list[tuple]:
    """The entry that is stored for the progress page."""
    made: list[tuple] = []
    monkeypatch.setattr(module, "store_check", lambda *check: made.append(check))
    return made


def written(folder: Path, text: str) -> Path:
    file = folder / "arm.txt"
    file.write_text(text, encoding="utf-8")
    return file


def test_what_is_missing_is_printed_link_by_link(
    tmp_path: Path, capsys: pytest.CaptureFixture, kept: list[tuple]
) -> None:
    lab.check_design(written(tmp_path, HALF), links=2)
    assert capsys.readouterr().out.splitlines()[1:] == [
        "  camera -> finder: failure is missing",
        "  camera -> finder: safety is missing",
        "  the task asks for at least 2 links",
    ]
    assert kept == [("arm", 4, 12)]


def test_a_design_with_all_six_facts_is_not_graded(
    tmp_path: Path, capsys: pytest.CaptureFixture, kept: list[tuple]
) -> None:
    lab.check_design(written(tmp_path, WHOLE))
    printed = capsys.readouterr().out
    assert "2 nodes, 1 link\n" in printed
    assert "Whether they are right is not checked here" in printed
    assert kept == [("arm", 6, 6)]


def test_a_design_is_drawn(tmp_path: Path) -> None:
    html = lab.draw_design(written(tmp_path, WHOLE), title="One link").data
    assert "<title>One link</title>" in html
    assert "camera -&gt; finder: topic sensor_msgs/msg/Image." in html


def test_for_a_missing_file_the_error_says_how_to_write_it(tmp_path: Path) -> None:
    with pytest.raises(lab.LabError, match=r"run the cell that begins %%writefile arm\.txt"):
        lab.draw_design(tmp_path / "arm.txt")


def test_for_a_file_without_a_link_an_example_is_printed(tmp_path: Path) -> None:
    with pytest.raises(lab.LabError, match="has no link yet; a link begins with"):
        lab.draw_design(written(tmp_path, "# YOUR CODE HERE\n"))


def test_a_file_that_is_not_text_raises_a_lab_error(tmp_path: Path) -> None:
    file = tmp_path / "arm.txt"
    file.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(lab.LabError, match="cannot be read"):
        lab.check_design(file)
