"""Measures what the toolkit costs, whether grading is fair, and how well the robot moves; nothing here is a test."""
