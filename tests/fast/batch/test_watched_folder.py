"""A watched folder yields each submission when it is complete, and again after a change."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.classroom.batch.watched_folder import WatchedFolder, only_watcher
from ros_runtime.course_error import CommandFailed


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "anna").mkdir()
    return tmp_path


def hand_in(folder: Path, text: str, student: str = "anna") -> None:
    (folder / student).mkdir(exist_ok=True)
    (folder / student / "battery_service.py").write_text(text)


def names(watched: WatchedFolder) -> list[str]:
    return [work.student for work in watched.poll()]


def test_a_submission_is_yielded_once_after_two_polls_find_it_unchanged(folder):
    watched = WatchedFolder(folder)
    assert names(watched) == []
    hand_in(folder, "half of")
    assert names(watched) == []
    hand_in(folder, "half of it was copied")
    assert names(watched) == []
    assert watched.unfinished == 1
    assert names(watched) == ["anna"]
    assert names(watched) == []
    assert watched.unfinished == 1
    (work,) = watched.collection.works
    watched.mark_graded(work)
    assert names(watched) == []
    assert watched.unfinished == 0


def test_a_submission_replaced_while_it_is_graded_is_yielded_again(folder):
    hand_in(folder, "first")
    watched = WatchedFolder(folder)
    names(watched)
    (work,) = watched.poll()
    hand_in(folder, "second")
    names(watched)
    assert names(watched) == []  # the first is being graded
    watched.mark_graded(work)
    assert watched.unfinished == 1
    assert names(watched) == ["anna"]


def test_a_submission_replaced_before_its_turn_waits_for_another_poll(folder):
    for student in ("anna", "bert"):
        hand_in(folder, "first", student)
    watched = WatchedFolder(folder)
    names(watched)
    turns = watched.poll()
    assert next(turns).student == "anna"
    hand_in(folder, "replaced while anna is graded", "bert")
    assert list(turns) == []
    assert names(watched) == []
    assert names(watched) == ["bert"]


def test_a_replacement_of_the_same_size_is_detected(folder):
    hand_in(folder, "first")
    watched = WatchedFolder(folder)
    names(watched)
    for work in watched.poll():
        watched.mark_graded(work)
    (folder / "new").write_text("other")
    (folder / "new").rename(folder / "anna/battery_service.py")
    names(watched)
    assert names(watched) == ["anna"]


def test_an_empty_folder_is_not_a_submission_but_one_with_another_file_is(folder):
    (folder / "anna/battery_service").mkdir()
    watched = WatchedFolder(folder)
    assert [names(watched) for _ in range(3)] == [[], [], []]
    (folder / "anna/battery_service/solution.txt").touch()
    assert names(watched) == ["anna"]


def test_a_folder_that_is_empty_or_has_gone_has_no_submissions(tmp_path):
    watched = WatchedFolder(tmp_path / "gone")
    assert names(watched) == []
    (tmp_path / "gone").mkdir()
    assert names(watched) == []


def test_a_second_watcher_is_refused_until_the_first_has_gone(tmp_path):
    with only_watcher(tmp_path):
        with pytest.raises(CommandFailed, match="--watch"), only_watcher(tmp_path):
            pass
        assert list(tmp_path.iterdir()) == []
    with only_watcher(tmp_path):
        pass
