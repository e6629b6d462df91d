"""What the author of an essay writes: the criteria by which a person marks it.

    CRITERIA = (Criterion("pattern", "The pattern of each link", {3: "every link has …", 2: "…", 0: "…"}), …)

They stand in the exercise's rubric.py, which takes the place of scenarios.py, checks.py and hidden.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType

Picture = Callable[[Mapping[str, str]], str | None]


@dataclass(frozen=True)
class Criterion:
    """What earns how many points.

    Attributes:
        id: the name of its cell, an identifier.
        title: what is looked at.
        levels: points and what earns them, from the most to the fewest.
    """

    id: str
    title: str
    levels: Mapping[int, str]

    @property
    def points(self) -> int:
        """The most it can earn."""
        return max(self.levels)


def criteria_in(module: ModuleType) -> Sequence[Criterion]:
    """Return the criteria of a rubric.

    Raises:
        ValueError: there are none, two have one id, or one can earn nothing.
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
    """Return the rubric's `picture`, if it has one: of the files handed in it makes the SVG that the marker sees."""
    picture: Picture | None = getattr(module, "picture", None)
    return picture
