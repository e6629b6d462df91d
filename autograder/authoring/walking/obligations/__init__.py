"""What must hold of every goal of a server that walks the robot to a pose, and of the robot while none is active."""
