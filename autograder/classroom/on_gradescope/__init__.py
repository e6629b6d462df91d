"""Grades an upload inside Gradescope's container, with the visible checks."""
