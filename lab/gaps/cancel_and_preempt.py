"""Chapter 7: cancel and preempt."""

from lab.gap import Gap

GAPS: tuple[Gap, ...] = ()
