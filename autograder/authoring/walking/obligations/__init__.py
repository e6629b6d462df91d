"""What must hold of every goal of a server that walks the robot to a pose, and of the robot while none is active.

Each function is what an obligation of an exercise's model requires:

comes_near = obligation(9, of=goals)(ends.comes_near)
"""
