"""Chapter 6: a client that sends the robot to a pose, follows it, and says how it ended."""
