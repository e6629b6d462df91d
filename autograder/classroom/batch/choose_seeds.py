"""Which seeds a batch gets: those it is given, else those of the batch that it continues, else new ones."""

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
        request: what is asked.
        before: the record that the output folder holds.
        grades: those it holds, in the folder of a version that wrote no record.
        works: the whole class.
    """
    if request.seed is not None:
        return Seeds(request.seed, request.seed_per_student)
    if request.goes_on and before:
        return replace(before.seeds, per_student=before.seed_per_student or request.seed_per_student)
    if request.goes_on and (one := _one_seed(grades)) is not None and not request.seed_per_student:
        return Seeds(one)
    if request.shard:  # the other machines have to come to the same
        return Seeds(seed_of_what_was_handed_in(works), request.seed_per_student)
    return Seeds(
        drawn_seed(), request.seed_per_student, per_submission=request.watch and not request.seed_per_student
    )


def _one_seed(grades: Sequence[Grade]) -> int | None:
    """The seed that all grades have, if it is one."""
    seeds = {grade.seed for grade in grades if grade.seed is not None}
    return seeds.pop() if len(seeds) == 1 else None
