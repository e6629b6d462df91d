"""What every ROS process of the course shares: its environment, its domain, messages, built interfaces, drawings."""
