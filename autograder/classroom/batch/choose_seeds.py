"""Chooses the seeds of a batch: the given ones, else those of the batch that it continues, else new ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from autograder.classroom.batch.batch_record import BatchRecord
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.seeds import Seeds, drawn_seed, seed_of_what_was_handed_in
from autograder.engine.verdict import Grade


def choose_seeds(
    request: BatchRequest, before: BatchRecord | None, grades: Sequence[Grade], works: Sequence[Work]
) -> Seeds:
    """Return the seeds of a batch.

    Args:
        request: the options of the batch.
        before: the record in the output folder, if any.
        grades: the grades in the output folder; used if an older version wrote no record.
        works: the submissions of the whole class.
    """
    if request.seed is not None:
        return Seeds(request.seed, request.seed_per_student)
    if request.goes_on and before:
        return replace(before.seeds, per_student=before.seed_per_student or request.seed_per_student)
    if request.goes_on and (one := _one_seed(grades)) is not None and not request.seed_per_student:
        return Seeds(one)
    if request.shard:  # all machines must compute the same seed
        return Seeds(seed_of_what_was_handed_in(works), request.seed_per_student)
    return Seeds(
        drawn_seed(), request.seed_per_student, per_submission=request.watch and not request.seed_per_student
    )


def _one_seed(grades: Sequence[Grade]) -> int | None:
    """The common seed of all grades; None if they differ."""
    seeds = {grade.seed for grade in grades if grade.seed is not None}
    return seeds.pop() if len(seeds) == 1 else None
