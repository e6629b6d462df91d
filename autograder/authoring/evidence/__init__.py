"""A run as it was recorded: its events, calls, goals and ground truth, to be asked by checks."""
