"""Left and right."""

from __future__ import annotations

from enum import IntEnum


class Side(IntEnum):
    """A side of the robot; its number is its index in every list of both sides."""

    LEFT = 0
    RIGHT = 1

    @property
    def letter(self) -> str:
        """The first letter in the names of its joints, bodies, sites, sensors and topics: "l" or "r"."""
        return "l" if self is Side.LEFT else "r"

    @property
    def sign(self) -> float:
        """The sign of y on this side: 1.0 left, -1.0 right."""
        return 1.0 if self is Side.LEFT else -1.0

    @property
    def other(self) -> Side:
        """The opposite side."""
        return Side.RIGHT if self is Side.LEFT else Side.LEFT

    @classmethod
    def of_letter(cls, letter: str) -> Side:
        """Return the side of "l" or "r".

        Raises:
            ValueError: it is another letter.
        """
        for side in cls:
            if side.letter == letter:
                return side
        raise ValueError(f"side {letter!r} is not known; expected 'l' or 'r'")


SIDES = (Side.LEFT, Side.RIGHT)
