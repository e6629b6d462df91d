"""Chapter 8: a client that sends the robot to a pose, and calls it off when the battery is low."""
