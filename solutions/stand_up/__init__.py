"""Chapter 10: an action server that makes the robot stand up from a crouch, in phases."""
