"""What just happened, as a sequence diagram."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from IPython.display import HTML

from lab import story
from lab.errors import LabError
from lab.story import Said
from ros_runtime.drawing.sequence_diagram import Arrow, sequence_svg

LABEL_LENGTH = 38  # characters that fit between two lifelines


def draw_sequence(title: str = "What just happened") -> HTML:
    """The last call or goal, with all that was said until now: requests solid, answers dashed, topics dotted.

    Of a stream of feedback only the first and the last message are drawn.

    Raises LabError when nothing was asked yet.
    """
    told = story.told()
    if not told:
        raise LabError("there is nothing to draw yet: use lab.call() or lab.send_goal() first")
    start = told[0].time
    arrows = [
        Arrow(said.time - start, said.sender, said.receiver, _shorten(said.label), said.kind)
        for said in _without_repetition(told)
    ]
    return HTML(sequence_svg(arrows, title=title))


def _without_repetition(told: Sequence[Said]) -> list[Said]:
    kept: list[Said] = []
    for key, stream in groupby(told, key=lambda said: (said.repeats, said.sender)):
        said = list(stream)
        if key[0] and len(said) > 3:
            middle = said[len(said) // 2]
            note = Said(
                middle.time, middle.sender, middle.receiver, f"… {len(said) - 2} more …", middle.kind, True
            )
            said = [said[0], note, said[-1]]
        kept += said
    return kept


def _shorten(label: str) -> str:
    return label if len(label) <= LABEL_LENGTH else label[: LABEL_LENGTH - 1] + "…"
