"""Writes two archives from a clone: the students' copy of the course, and the autograder for Gradescope."""
