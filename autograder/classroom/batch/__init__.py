"""Grades a whole class: finds the submissions, grades them in parallel, caches and writes the grades."""
