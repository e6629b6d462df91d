"""nbgrader before and after grading: release notebooks for students, gradebook and feedback from verdicts.

nbgrader never reads a student's own file and never runs a cell: instead of executing it, `VerdictOutputs` writes the
verdicts as cell outputs.
"""
