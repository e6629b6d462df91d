"""Fuzzers: what a student can send, made up from a seed, and what must hold whatever it is.

Each has a name and a seed. `readers/` looks at one reader of the controller at a time, in this process; `arena/` runs
made-up programs in arenas. `course test --fuzz MINUTES` goes from seed to seed; the tests take a few fixed ones.
"""
