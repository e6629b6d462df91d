"""The verbs: one file for each group, and separate files for long verbs."""
