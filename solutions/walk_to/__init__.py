"""An action server that walks the robot to a pose, one goal at a time."""
