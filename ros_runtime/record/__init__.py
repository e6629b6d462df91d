"""Typed events, a log of them on which code can wait, and their conversion to lines of JSON for other processes."""
