"""The verbs: one file for each group, and separate files for long verbs.

Any of their functions may raise a `CommandError`, whose message says why.
"""
