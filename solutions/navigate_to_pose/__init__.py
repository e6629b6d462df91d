"""Chapter 8: an action server that brings the robot to a pose some metres away and tells how it goes."""
