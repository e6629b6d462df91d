"""Workarounds for faults of other software; README.md says why each is needed and how to remove it."""
