"""Fuzzers: generated input that a student could send, and the properties that must hold for it.

`readers/` tests one reader of the controller at a time, in this process; `arena/` runs generated programs in arenas.
"""
