"""New and changed submissions in a folder that people hand in to, each as soon as it is wholly there.

The folder is read again and again. Notifications of the kernel (inotify) would be quicker, but a network file system
sends none for what another machine wrote, and a file that is still being copied has to be looked at twice anyway.
"""

from __future__ import annotations

import fcntl
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from autograder.classroom.batch.collection import Collection, NoSubmissions, Work, collect
from autograder.classroom.batch.folder_lock import FolderInUse

Key = tuple[str, str]
Stamp = tuple[tuple[str, int, int, int], ...]  # of each file: its name, inode, size and time of change


class WatchedFolder:
    """Tells at each look which submissions are to be graded now: those that changed, and are as at the last look."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._seen: dict[Key, Stamp] = {}
        self._taken: dict[Key, Stamp] = {}
        self._in_work: set[Key] = set()
        self.collection = Collection([], [], [])
        self.seconds = 0.0  # that the last look took

    def look(self) -> Iterator[Work]:
        """Yield what is to be graded; each counts as in work until `is_graded`.

        What changes while it is graded comes again after that.
        """
        began = time.monotonic()
        try:
            self.collection = collect(self._folder)
        except NoSubmissions:
            self.collection = Collection([], [], [])
        except OSError:  # something went away between two steps: the next look will see
            return
        before, self._seen = self._seen, {_key(work): _stamp(work) for work in self.collection.works}
        self.seconds = time.monotonic() - began
        for work in self.collection.works:
            key = _key(work)
            if key in self._in_work or before.get(key) != self._seen[key] or self._is_empty(work):
                continue
            now = _stamp(work)  # what comes first in a look is graded for a while before this is reached
            if now == self._seen[key] != self._taken.get(key):
                self._taken[key] = now
                self._in_work.add(key)
                yield work

    def is_graded(self, work: Work) -> None:
        """Say that there is a grade, so that what was handed in meanwhile may come."""
        self._in_work.discard(_key(work))

    def _is_empty(self, work: Work) -> bool:
        """Whether there is a folder for the exercise and nothing in it yet."""
        if work.candidates:
            return False
        try:
            return not any((self._folder / work.student / work.exercise).iterdir())
        except OSError:
            return True

    @property
    def unfinished(self) -> int:
        """How many submissions have no grade yet in the state in which they are."""
        changed = {key for key, stamp in self._seen.items() if stamp and stamp != self._taken.get(key)}
        return len(changed | self._in_work)


@contextmanager
def only_watcher(folder: Path) -> Iterator[None]:
    """Hold the folder as its only watcher, without writing into it.

    Raises:
        FolderInUse: another process watches it.
    """
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise FolderInUse(
                f"another `course grade --watch` watches {folder}: end it first, with Ctrl-C"
            ) from None
        except OSError:  # a file system without locks on folders; the lock of --out remains
            pass
        yield
    finally:
        os.close(descriptor)


def _key(work: Work) -> Key:
    return work.student, work.exercise


def _stamp(work: Work) -> Stamp:
    """What tells one state of the files from another; a file that is not there has no part in it."""
    stamps = []
    for path in work.files():
        try:
            stat = path.lstat()
        except OSError:
            continue
        stamps.append((path.name, stat.st_ino, stat.st_size, stat.st_mtime_ns))
    return tuple(stamps)
