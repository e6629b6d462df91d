"""The archives that leave the clone: the students', and the one for Gradescope."""
