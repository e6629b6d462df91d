"""Chapter 6: a client that sends the robot to a pose, prints the feedback, and reports the result."""
