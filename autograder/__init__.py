"""Grades ROS 2 nodes by what they do: submission → arena → transcript → verdict → report."""
