"""Chapter 4: your own interfaces."""

from lab.gap import Gap

GAPS: tuple[Gap, ...] = ()
