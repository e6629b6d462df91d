"""Uses nbgrader before grading, for release notebooks, and after it, for gradebook and feedback from the verdicts.

nbgrader never reads a student's own file and never runs a cell: `VerdictOutputs` writes the verdicts as cell outputs
instead.
"""
