"""Chapter 1: robot and graph."""

from lab.gap import Gap

GAPS: tuple[Gap, ...] = ()
