"""Measures what arenas and gradings cost, and whether a correct program passes at every scale of the clock."""
