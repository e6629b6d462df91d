"""Chapter 8: a client that sends the robot to a pose, and cancels the goal when the battery is low."""
