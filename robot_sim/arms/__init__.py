"""Waist, head, arms and hands: trajectories, reaching, gripping."""
