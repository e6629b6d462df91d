"""Chapter 8: an action server that walks the robot to a pose some metres away and publishes its progress."""
