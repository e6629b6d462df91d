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


@pytest.mark.parametrize(
    ("comments", "needs", "said"),
    [
        ("# need 1\n# needs 2, 3 and 4\n", 0, ""),
        ("# need 1\n# needs 2, 4\n", 0, "no comment beside a link names the need 3"),
        ("# need 1\n#\n", 3, "no comment beside a link names the needs 2, 3"),
        ("# in 30 s\n# need 1 of 30\n", 0, ""),
        ("# needs 1,2\n# need 999999999\n", 0, ""),
    ],
)
def test_needs_that_no_comment_names_are_listed(
    tmp_path: Path, capsys: pytest.CaptureFixture, kept: list[tuple], comments: str, needs: int, said: str
) -> None:
    first, second = comments.splitlines()
    text = (
        f"# need 5\n{WHOLE.replace('Image', f'Image  {first}')}{WHOLE.replace('Image', f'Image  {second}')}"
    )
    lab.check_design(written(tmp_path, text), needs=needs)
    printed = capsys.readouterr().out
    assert said in printed
    assert ("names the need" in printed) == bool(said)
    assert len(kept) == 1


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
