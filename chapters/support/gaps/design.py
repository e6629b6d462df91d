"""Chapter 12: a design. It has no gaps, because an instructor marks the design."""

from lab.learning.gap import Gap

GAPS: tuple[Gap, ...] = ()
