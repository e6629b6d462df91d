"""Grades submissions as they arrive in a folder, until Ctrl-C; the results are updated after each one."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace

from rich.console import Console

from autograder.classroom.batch.batch_record import write_batch
from autograder.classroom.batch.collection import NoSubmissions, Work
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.watched_folder import WatchedFolder, only_watcher
from autograder.classroom.class_grading.class_files import ClassFiles
from autograder.classroom.class_grading.output import left_aside, print_problems, print_ungraded
from autograder.classroom.class_grading.setting import Setting, prepared
from course_cli.ending import batch_status

BETWEEN_LOOKS = 1.0  # s at least
SHARE_OF_TIME = 0.1  # at most, of polling the folder, and again of writing the files on the whole class
_STEP = 0.2  # s


def watch_and_grade(console: Console, request: BatchRequest) -> int:
    """Grade until Ctrl-C; return the exit status: 0 if every submission found has a grade in the gradebook.

    Raises:
        NoSubmissions: there is no such folder; an empty one is fine.
        FolderInUse: another process watches it.
        UnusableExercise: an author has something to mend.
        Exception: those of `prepared`.
    """
    if not request.submitted.is_dir():
        raise NoSubmissions(f"{request.submitted} is not a folder; make it first, then watch it")
    with only_watcher(request.submitted), prepared(console, request, ()) as setting:
        return _Watch(setting).run()


class _Watch:
    """A watched folder with the files and the results so far."""

    def __init__(self, setting: Setting) -> None:
        self._setting = setting
        self._folder = WatchedFolder(setting.request.submitted)
        self._record = setting.record
        self._files = ClassFiles(
            setting.request.out, setting.before, setting.record, json_file=setting.request.json_file
        )
        self._results: dict[tuple[str, str], Graded] = {}
        self._is_written = True  # whether the files on the whole class are up to date
        self._next_writing = 0.0  # s, monotonic

    def run(self) -> int:
        setting, request = self._setting, self._setting.request
        write_batch(request.out, self._record)
        setting.console.print(
            f"watching {request.submitted}; Ctrl-C ends this, and the same command continues", markup=False
        )
        try:
            with closing(setting.graded(self._works())) as graded:
                for result in graded:
                    self._keep(result)
        except KeyboardInterrupt:
            pass
        self._record = replace(
            self._record,
            left_aside=left_aside(self._folder.collection, self._results.values()),
            refused=self._folder.collection.refused,
        ).closed("interrupted" if self._folder.unfinished else "ended")
        self._write_class()
        return self._print_summary()

    def _works(self) -> Iterator[Work | None]:
        """Yield new submissions; None while there are none."""
        while True:
            for work in self._folder.poll():
                if self._setting.request.selects(work.student, work.exercise):
                    yield work
                else:
                    self._folder.mark_graded(work)
            next_look = time.monotonic() + max(BETWEEN_LOOKS, self._folder.seconds / SHARE_OF_TIME)
            while time.monotonic() < next_look:
                yield None
                self._write_class_when_due()
                time.sleep(_STEP)

    def _keep(self, result: Graded) -> None:
        """Write the files on a result, and those on the class when they are due."""
        self._files.add(result)
        self._record = self._record.with_results([result])
        self._results[result.work.student, result.work.exercise] = result
        self._folder.mark_graded(result.work)
        self._is_written = False
        self._write_class_when_due()

    def _write_class_when_due(self) -> None:
        """Write the files on the whole class, at most as often as SHARE_OF_TIME allows: a large class takes longer."""
        began = time.monotonic()
        if self._is_written or began < self._next_writing:
            return
        self._write_class()
        now = time.monotonic()
        self._next_writing = now + (now - began) / SHARE_OF_TIME

    def _write_class(self) -> None:
        self._files.record = self._record
        self._files.write(self._folder.collection.refused)
        self._is_written = True

    def _print_summary(self) -> int:
        console = self._setting.console
        is_entered = print_problems(console, self._files)
        not_graded = print_ungraded(console, self._folder.collection, self._results.values())
        waiting = self._folder.unfinished
        console.print(
            f"{len(self._results)} graded"
            + (f", {waiting} not graded yet: the same command continues with them" if waiting else ""),
        )
        return batch_status(not_graded=not_graded, complete=is_entered and not waiting)
