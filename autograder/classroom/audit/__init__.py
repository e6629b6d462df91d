"""Tests the grader: submissions with known faults are graded with every check, as in mutation testing."""
