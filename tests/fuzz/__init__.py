"""Fuzzers: what a student can send, made up, and what must hold whatever it is.

`readers/` looks at one reader of the controller at a time, in this process; `arena/` runs made-up programs in arenas.
"""
