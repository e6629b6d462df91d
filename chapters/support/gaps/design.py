"""Chapter 12: the design of links. It has no gaps: a person marks a design."""

from lab.learning.gap import Gap

GAPS: tuple[Gap, ...] = ()
