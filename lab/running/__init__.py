"""Starts and ends the robot and students' programs."""
