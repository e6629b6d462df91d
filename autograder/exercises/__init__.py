"""The exercises the autograder knows: a folder each, with scenarios (run in the arena) and checks (run outside)."""
