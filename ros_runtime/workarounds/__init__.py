"""Workarounds for faults of other software; README.md says for each why it is there and how to remove it."""
