"""A recorded run, as checks query it: its events, calls, goals and ground truth."""
