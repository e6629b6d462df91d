"""Judges walks to a pose: where the robot arrived, whether it stopped, and whether feedback and result are true."""
