"""Watches a hand-in folder and yields new and changed submissions once they are complete.

The folder is polled. Kernel notifications (inotify) would be quicker, but a network file system sends none for files
written by other machines, and a file that is still being copied has to be checked twice anyway.
"""

from __future__ import annotations

import fcntl
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from autograder.classroom.batch.collection import Collection, NoSubmissions, Work, collect
from ros_runtime.course_error import CommandFailed

Key = tuple[str, str]
Stamp = tuple[tuple[str, int, int, int], ...]  # name, inode, size and modification time of each file


class WatchedFolder:
    """Finds the submissions to grade: new or changed ones whose files are the same in two polls."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._seen: dict[Key, Stamp] = {}
        self._taken: dict[Key, Stamp] = {}
        self._being_graded: set[Key] = set()
        self.collection = Collection([], [], [])
        self.seconds = 0.0  # duration of the last poll

    def poll(self) -> Iterator[Work]:
        """Poll the folder and yield the submissions to grade; each counts as being graded until `mark_graded`.

        A submission that changes while it is being graded is yielded again afterwards.
        """
        began = time.monotonic()
        try:
            self.collection = collect(self._folder)
        except NoSubmissions:
            self.collection = Collection([], [], [])
        except OSError:  # a file vanished while it was read: try again at the next poll
            return
        before, self._seen = self._seen, {_key(work): _stamp(work) for work in self.collection.works}
        self.seconds = time.monotonic() - began
        for work in self.collection.works:
            key = _key(work)
            if key in self._being_graded or before.get(key) != self._seen[key] or self._is_empty(work):
                continue
            now = _stamp(work)  # check again, because grading the earlier submissions may have taken a while
            if now == self._seen[key] != self._taken.get(key):
                self._taken[key] = now
                self._being_graded.add(key)
                yield work

    def mark_graded(self, work: Work) -> None:
        """Mark a submission as graded, so that a newer version of it can be yielded."""
        self._being_graded.discard(_key(work))

    def _is_empty(self, work: Work) -> bool:
        """Whether the exercise's folder is empty or missing."""
        if work.candidates:
            return False
        try:
            return not any((self._folder / work.student / work.exercise).iterdir())
        except OSError:
            return True

    @property
    def unfinished(self) -> int:
        """Number of submissions whose present version has no grade yet."""
        changed = {key for key, stamp in self._seen.items() if stamp and stamp != self._taken.get(key)}
        return len(changed | self._being_graded)


@contextmanager
def only_watcher(folder: Path) -> Iterator[None]:
    """Lock the folder as its only watcher; nothing is written into it.

    Raises:
        CourseError: another process watches it.
    """
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise CommandFailed(
                f"another `course grade --watch` watches {folder}: end it first, with Ctrl-C"
            ) from None
        except OSError:  # this file system cannot lock folders; --out is locked all the same
            pass
        yield
    finally:
        os.close(descriptor)


def _key(work: Work) -> Key:
    return work.student, work.exercise


def _stamp(work: Work) -> Stamp:
    """Return the stamps of a submission's files, without missing files."""
    stamps = []
    for path in work.files():
        try:
            stat = path.lstat()
        except OSError:
            continue
        stamps.append((path.name, stat.st_ino, stat.st_size, stat.st_mtime_ns))
    return tuple(stamps)
