"""Draws the robot, the graph, and what has happened: sequence diagrams, plots, time lines and films."""
