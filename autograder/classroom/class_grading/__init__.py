"""Grades a class for `course grade`: once, or as submissions come in; shows how it goes and writes the results."""
