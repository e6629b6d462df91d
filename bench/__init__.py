"""What the toolkit costs, whether it stays fair, and how well the robot moves: measured and printed, never a test."""
