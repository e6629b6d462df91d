"""Chapter 3: clients that survive."""

from lab.gap import Gap

GAPS: tuple[Gap, ...] = ()
