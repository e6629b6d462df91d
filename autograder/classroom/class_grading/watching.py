"""Grades submissions as they arrive in a folder, until Ctrl-C; the results are updated after each one."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace

from rich.console import Console

from autograder.classroom.batch.batch_record import write_batch
from autograder.classroom.batch.collection import NoSubmissions, Work
from autograder.classroom.batch.records import GRADES, write_grades
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.selection import with_others
from autograder.classroom.batch.source_files import write_base_code, write_sources
from autograder.classroom.batch.watched_folder import WatchedFolder, only_watcher
from autograder.classroom.class_grading.gradebook_writer import GradebookWriter
from autograder.classroom.class_grading.once import left_aside, tell_what_is_left
from autograder.classroom.class_grading.progress import BatchProgress
from autograder.classroom.class_grading.setting import Setting, prepared
from autograder.classroom.nbgrader_bridge.course_folder import RELEASE
from autograder.classroom.pages.drawings import Drawings
from autograder.classroom.pages.pages import write_class_page, write_student_page, write_submission_pages
from course_cli.ending import batch_status

BETWEEN_LOOKS = 1.0  # s at least
SHARE_OF_TIME = (
    0.1  # highest share of time for polling the folder, and again for writing the files on the whole class
)
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
    """A watched folder with the grades, record and results so far."""

    def __init__(self, setting: Setting) -> None:
        self._setting = setting
        self._folder = WatchedFolder(setting.request.submitted)
        self._writer = GradebookWriter(setting.request.out)
        self._grades = list(setting.before)
        self._record = setting.record
        self._results: dict[tuple[str, str], Graded] = {}
        self._is_written = True  # whether the files on the whole class are up to date
        self._next_writing = 0.0  # s, monotonic

    def run(self) -> int:
        setting, request = self._setting, self._setting.request
        write_batch(request.out, self._record)
        setting.console.print(
            f"watching {request.submitted}; Ctrl-C ends this, and the same command continues", markup=False
        )
        elsewhere = setting.cluster.size if setting.cluster else 0
        with BatchProgress(setting.console, elsewhere=elsewhere) as progress:
            runner = setting.runner(progress)
            try:
                with closing(runner.run(self._works())) as graded:
                    for result in graded:
                        progress.graded(result, runner.count(result.work.exercise))
                        self._keep(result)
            except KeyboardInterrupt:
                pass
        self._record = replace(
            self._record,
            left_aside=left_aside(self._folder.collection, list(self._results.values())),
            refused=self._folder.collection.refused,
        ).closed("interrupted" if self._folder.unfinished else "ended")
        self._write_class()
        return self._tell_the_end()

    def _works(self) -> Iterator[Work | None]:
        """Yield new submissions; None while there are none."""
        while True:
            for work in self._folder.look():
                if self._setting.request.selects(work.student, work.exercise):
                    yield work
                else:
                    self._folder.is_graded(work)
            next_look = time.monotonic() + max(BETWEEN_LOOKS, self._folder.seconds / SHARE_OF_TIME)
            while time.monotonic() < next_look:
                yield None
                self._write_class_when_due()
                time.sleep(_STEP)

    def _keep(self, result: Graded) -> None:
        """Enter a result into the gradebook, write its pages and program, and the class's files when they are due."""
        out = self._setting.request.out
        grade = self._writer.enter(result)
        self._grades = with_others([grade], self._grades)
        self._record = self._record.with_results([result]).with_points([grade])
        self._results[grade.student, grade.exercise] = result
        write_submission_pages(out, grade, Drawings(out).of(grade, result.sources))
        theirs = [each for each in self._grades if each.student == grade.student]
        write_student_page(out, grade.student, theirs)
        write_sources(out, [result])
        write_base_code(out, [grade.exercise], out / RELEASE)
        self._folder.is_graded(result.work)
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
        request = self._setting.request
        write_grades(request.out / GRADES, self._grades)
        if request.json_file:
            write_grades(request.json_file, self._grades)
        write_batch(request.out, self._record)
        write_class_page(
            request.out, self._grades, self._folder.collection.refused, batch=self._record.in_words()
        )
        self._is_written = True

    def _tell_the_end(self) -> int:
        console, problems = self._setting.console, self._writer.problems()
        for line in problems:
            console.print(f"not in the gradebook: {line}", style="red", markup=False)
        not_graded = tell_what_is_left(console, self._folder.collection, list(self._results.values()))
        waiting = self._folder.unfinished
        console.print(
            f"{len(self._results)} graded"
            + (f", {waiting} not graded yet: the same command continues with them" if waiting else ""),
        )
        return batch_status(not_graded=not_graded, complete=not (problems or waiting))
