"""Raises before it creates a node."""

raise RuntimeError("no such robot")
