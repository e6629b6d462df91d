"""Requirements on every goal of a server that walks the robot to a pose, and on the robot while no goal is active.

An exercise's model makes an obligation of each function:

comes_near = obligation(9, of=goals)(ends.comes_near)
"""
