"""Grades the submissions in a folder once, and writes all results at the end."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace

from rich.console import Console

from autograder.classroom.batch.batch_record import BatchRecord, write_batch
from autograder.classroom.batch.collection import Work, collect
from autograder.classroom.batch.records import GRADES, write_grades
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.selection import select, with_others
from autograder.classroom.batch.shards import SHARD, write_shard
from autograder.classroom.class_grading.class_files import ClassFiles
from autograder.classroom.class_grading.output import (
    add_all,
    left_aside,
    print_changed_checks,
    print_recordings,
    print_summary,
    print_ungraded,
)
from autograder.classroom.class_grading.prepared_batch import PreparedBatch, prepared
from course_cli.ending import batch_status


def grade_once(console: Console, request: BatchRequest) -> int:
    """Grade a batch; return the exit status: 0 if every submission has a grade in the gradebook.

    Raises:
        CourseError: there is nothing to grade.
        UnusableExercise: the exercise's author has to correct the exercise.
        CourseError: as `prepared`.
    """
    collection = collect(request.submitted)
    works = select(collection.works, request.students, request.exercises)
    is_entered = True
    with prepared(console, request, collection.works) as batch:
        record = replace(batch.record, left_aside=collection.ignored, refused=collection.refused)
        if request.resume:
            print_changed_checks(console, record, works)
        results = _grade(batch, request.shard.part(works) if request.shard else works, record)
        rows = record.rows if request.keeps_others else ()  # without the rows of removed submissions
        record = replace(record, rows=rows, left_aside=left_aside(collection, results))
        record = record.with_results(results).closed("ended")
        grades = with_others([result.grade for result in results], batch.before)
        write_grades(request.out / GRADES, grades)
        if request.shard:
            write_batch(request.out, record)
            write_shard(request.out, request.shard, batch.seeds, collection.works, results)
        else:
            files = ClassFiles(
                request.out, grades, record, json_file=request.json_file, deadlines=request.deadlines
            )
            add_all(console, files, results)
            add_all(console, files, files.outdated(collection.works))
            is_entered = print_summary(console, files, request.out, files.write(collection.refused))
    not_graded = print_ungraded(console, collection, results)
    if request.record:
        print_recordings(console, request.out, results)
    if request.shard:
        console.print(
            f"{request.out / SHARD}; merge all shards with `course merge`", style="dim", markup=False
        )
    return batch_status(not_graded=not_graded, complete=is_entered and not collection.refused)


def _grade(batch: PreparedBatch, works: Sequence[Work], record: BatchRecord) -> list[Graded]:
    """Grade in parallel and return the results in the order of the submissions."""
    out, results = batch.request.out, dict[Work, Graded]()
    write_batch(out, record)  # stores the seed, so that a killed batch can be resumed with it
    try:
        with closing(batch.graded(works)) as graded:
            for result in graded:
                results[result.work] = result
    except KeyboardInterrupt:
        write_batch(out, record.with_results(list(results.values())).closed("interrupted"))
        raise
    return [results[work] for work in works]
