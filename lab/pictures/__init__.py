"""Draws what happened: robot, graph, sequences, plots."""
