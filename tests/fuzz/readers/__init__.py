"""Fuzzers of what the controller reads, one reader at a time, in this process."""
