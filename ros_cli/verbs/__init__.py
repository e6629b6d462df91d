"""The verbs, one file a group; those of a group that need more have a file of their own."""
