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
from autograder.classroom.class_grading.prepared_batch import PreparedBatch, prepared
from course_cli.ending import batch_status

MIN_POLL_PERIOD = 1.0  # s
# Share of the time for polling the folder, and the same share for writing the files on the whole class.
MAX_TIME_SHARE = 0.1
_SLEEP_TIME = 0.2  # s


def watch_and_grade(console: Console, request: BatchRequest) -> int:
    """Grade until Ctrl-C; return the exit status: 0 if every submission found has a grade in the gradebook.

    Raises:
        CourseError: the folder does not exist (an empty folder is allowed).
        CourseError: another process watches the folder.
        UnusableExercise: the exercise's author has to correct the exercise.
        CourseError: as `prepared`.
    """
    if not request.submitted.is_dir():
        raise NoSubmissions(f"{request.submitted} is not a folder; create it first")
    with only_watcher(request.submitted), prepared(console, request, ()) as batch:
        return _Watch(batch).run()


class _Watch:
    """A watched folder, with the class's files and the results so far."""

    def __init__(self, batch: PreparedBatch) -> None:
        self._batch = batch
        self._folder = WatchedFolder(batch.request.submitted)
        self._record = batch.record
        self._files = ClassFiles(
            *(batch.request.out, batch.before, batch.record),
            json_file=batch.request.json_file,
            deadlines=batch.request.deadlines,
        )
        self._results: dict[tuple[str, str], Graded] = {}
        self._is_written = True  # whether the files on the whole class are up to date
        self._next_writing = 0.0  # s, monotonic

    def run(self) -> int:
        batch, request = self._batch, self._batch.request
        write_batch(request.out, self._record)
        batch.console.print(
            f"watching {request.submitted}; stop with Ctrl-C, and continue with the same command",
            markup=False,
        )
        try:
            with closing(batch.graded(self._works())) as graded:
                for result in graded:
                    self._keep(result)
        except KeyboardInterrupt:
            pass
        self._record = replace(
            self._record,
            left_aside=left_aside(self._folder.collection, self._results.values()),
            refused=self._folder.collection.refused,
        ).closed("interrupted" if self._folder.unfinished else "ended")
        for result in self._files.outdated(self._folder.collection.works):
            self._files.add(result)
        self._write_class()
        return self._print_summary()

    def _works(self) -> Iterator[Work | None]:
        """Yield new submissions, and None while there is no new submission."""
        while True:
            for work in self._folder.poll():
                if self._batch.request.selects(work.student, work.exercise):
                    yield work
                else:
                    self._folder.mark_graded(work)
            next_poll = time.monotonic() + max(MIN_POLL_PERIOD, self._folder.seconds / MAX_TIME_SHARE)
            while time.monotonic() < next_poll:
                yield None
                self._write_class_when_due()
                time.sleep(_SLEEP_TIME)

    def _keep(self, result: Graded) -> None:
        """Write the files of a result, and those of the whole class when they are due."""
        self._files.add(result)
        self._record = self._record.with_results([result])
        self._results[result.work.student, result.work.exercise] = result
        self._folder.mark_graded(result.work)
        self._is_written = False
        self._write_class_when_due()

    def _write_class_when_due(self) -> None:
        """Write the files of the whole class if they have changed, as often as MAX_TIME_SHARE allows."""
        began = time.monotonic()
        if self._is_written or began < self._next_writing:
            return
        self._write_class()
        now = time.monotonic()
        self._next_writing = now + (now - began) / MAX_TIME_SHARE

    def _write_class(self) -> None:
        self._files.record = self._record
        self._files.write(self._folder.collection.refused)
        self._is_written = True

    def _print_summary(self) -> int:
        console = self._batch.console
        is_entered = print_problems(console, self._files)
        not_graded = print_ungraded(console, self._folder.collection, self._results.values())
        waiting = self._folder.unfinished
        console.print(
            f"{len(self._results)} graded"
            + (f", {waiting} not graded yet: continue with the same command" if waiting else ""),
        )
        return batch_status(not_graded=not_graded, complete=is_entered and not waiting)
