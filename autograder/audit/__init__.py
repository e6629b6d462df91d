"""Proof that the grader grades: submissions whose faults are known, against every check."""
