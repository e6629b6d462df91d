"""Ends before it is a node."""

raise RuntimeError("no such robot")
