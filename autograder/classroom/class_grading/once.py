"""Grades what is in a folder, and writes everything at the end."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace

from rich.console import Console

from autograder.classroom.batch.batch_record import BatchRecord, write_batch
from autograder.classroom.batch.collection import Collection, Work, collect
from autograder.classroom.batch.records import GRADES, write_grades
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.selection import select, with_others
from autograder.classroom.batch.shards import SHARD, write_shard
from autograder.classroom.batch.source_files import write_base_code, write_sources
from autograder.classroom.class_grading.output import enter_all, sources_of, tell_of_recordings, tell_the_end
from autograder.classroom.class_grading.progress import BatchProgress
from autograder.classroom.class_grading.setting import Setting, prepared
from autograder.classroom.nbgrader_bridge.course_folder import RELEASE
from autograder.classroom.pages.pages import write_pages
from course_cli.ending import batch_status


def grade_once(console: Console, request: BatchRequest) -> int:
    """Grade a batch; return the exit status: 0 if all that was handed in has a grade and is in the gradebook.

    Raises:
        NoSubmissions, NothingSelected: there is nothing to grade.
        UnusableExercise: an author has something to mend.
        Exception: those of `prepared`.
    """
    collection = collect(request.submitted)
    works = select(collection.works, request.students, request.exercises)
    with prepared(console, request, collection.works) as setting:
        record = replace(setting.record, left_aside=collection.ignored, refused=collection.refused)
        results = _grade(setting, request.shard.part(works) if request.shard else works, record)
        rows = record.rows if request.keeps_others else ()  # drops the rows of removed submissions
        record = replace(record, rows=rows, left_aside=left_aside(collection, results))
        record = record.with_results(results).closed("ended")
        if request.shard:
            write_batch(request.out, record)
            is_entered = _write_shard(setting, collection.works, results)
        else:
            is_entered = _write_class(setting, collection, record, results)
    not_graded = tell_what_is_left(console, collection, results)
    if request.record:
        tell_of_recordings(console, request.out, results)
    if request.shard:
        console.print(
            f"{request.out / SHARD}; join all of them with `course merge`", style="dim", markup=False
        )
    return batch_status(not_graded=not_graded, complete=is_entered and not collection.refused)


def _grade(setting: Setting, works: Sequence[Work], record: BatchRecord) -> list[Graded]:
    """Grade in parallel and return the results in the order of the submissions."""
    out, results = setting.request.out, dict[Work, Graded]()
    elsewhere = setting.cluster.size if setting.cluster else 0
    with BatchProgress(setting.console, elsewhere=elsewhere) as progress:
        runner = setting.runner(progress)
        progress.expect(sum(runner.count(work.exercise) for work in works), len(works))
        write_batch(out, record)  # stores the seed, so that a killed batch can be resumed with it
        try:
            with closing(runner.run(works)) as graded:
                for result in graded:
                    results[result.work] = result
                    progress.graded(result, runner.count(result.work.exercise))
        except KeyboardInterrupt:
            write_batch(out, record.with_results(list(results.values())).closed("interrupted"))
            raise
    return [results[work] for work in works]


def _write_shard(setting: Setting, whole_class: Sequence[Work], results: Sequence[Graded]) -> bool:
    request = setting.request
    assert request.shard
    write_grades(request.out / GRADES, [result.grade for result in results])
    write_shard(request.out, request.shard, setting.seeds, whole_class, results)
    return True


def _write_class(
    setting: Setting, collection: Collection, record: BatchRecord, results: Sequence[Graded]
) -> bool:
    """Write grades, gradebook and pages; return whether every grade is in the gradebook."""
    request, out = setting.request, setting.request.out
    write_grades(out / GRADES, with_others([result.grade for result in results], setting.before))
    unentered, entered = enter_all(setting.console, results, out)
    grades = with_others(entered, setting.before)
    write_grades(out / GRADES, grades)  # written again, with the points that a person gave for essays
    if request.json_file:
        write_grades(request.json_file, grades)
    record = record.with_points(grades)
    write_batch(out, record)
    write_sources(out, results)
    write_base_code(out, [result.work.exercise for result in results], out / RELEASE)
    page = write_pages(out, grades, sources_of(results), left_out=collection.refused, batch=record.in_words())
    tell_the_end(setting.console, grades, unentered, out, page)
    return not unentered


def left_aside(collection: Collection, results: Sequence[Graded]) -> list[str]:
    """Return a sentence on each file or folder that was handed in and is not graded."""
    return [*collection.ignored, *(line for result in results for line in result.work.left_aside)]


def tell_what_is_left(console: Console, collection: Collection, results: Sequence[Graded]) -> int:
    """Print what has no grade; return the number of submissions that the grader failed to judge."""
    for line in left_aside(collection, results):
        console.print(f"left aside: {line}", style="yellow", markup=False)
    for line in collection.refused:
        console.print(f"not graded: {line}", style="red", markup=False)
    not_graded = sum(result.grade.status == "not graded" for result in results)
    if not_graded:
        console.print(
            f"{not_graded} not graded; try those again with --resume --jobs 1, when the machine has less to do",
            style="magenta",
        )
    return not_graded
