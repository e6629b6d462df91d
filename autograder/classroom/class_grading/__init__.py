"""Grades a class for `course grade`, once or as submissions arrive; shows the progress and writes the results."""
