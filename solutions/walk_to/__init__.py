"""Chapter 6: an action server that walks the robot to a pose, one goal at a time."""
