"""The robot's ROS face: its node, the services around it, and the loop that drives both."""
