"""Measures what arenas, gradings and checks cost, and whether a correct program passes at every scale of the clock."""
