"""What the robot feels, and where it believes it is."""
