"""nbgrader on both ends of the grader: release notebooks for students, gradebook and feedback from verdicts.

nbgrader never sees a student's own file and never runs a cell: its place of execution is taken by
`VerdictOutputs`, which writes what the arenas have found.
"""
