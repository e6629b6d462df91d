"""The rubric of an essay: the criteria by which a person marks it.

    CRITERIA = (Criterion("pattern", "The pattern of each link", {3: "every link has …", 2: "…", 0: "…"}), …)

The exercise defines them in rubric.py, and has no scenarios.py, checks.py and hidden.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType

Picture = Callable[[Mapping[str, str]], str | None]


@dataclass(frozen=True)
class Criterion:
    """One criterion with its levels.

    Attributes:
        id: the name of its cell, an identifier.
        title: what is marked.
        levels: for each number of points, what earns it, from the most to the fewest.
    """

    id: str
    title: str
    levels: Mapping[int, str]

    @property
    def points(self) -> int:
        """The points of its highest level."""
        return max(self.levels)


def criteria_in(module: ModuleType) -> Sequence[Criterion]:
    """Return the criteria of a rubric.

    Raises:
        ValueError: there are none, two have the same id, or one can earn no points.
    """
    criteria = tuple(getattr(module, "CRITERIA", ()))
    if not criteria:
        raise ValueError("it has no CRITERIA")
    ids = [criterion.id for criterion in criteria]
    for criterion in criteria:
        if ids.count(criterion.id) > 1:
            raise ValueError(f"two criteria are called {criterion.id!r}")
        if not criterion.levels or criterion.points <= 0:
            raise ValueError(f"the criterion {criterion.id!r} can earn no points")
    return criteria


def picture_in(module: ModuleType) -> Picture | None:
    """Return the rubric's function `picture`, if any: it draws the submitted files as an SVG for the marker."""
    picture: Picture | None = getattr(module, "picture", None)
    return picture
