"""Starts and stops the robot and the students' programs."""
