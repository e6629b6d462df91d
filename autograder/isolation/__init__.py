"""Sandboxed processes: the arena (`arena_process`) and the student's program in it (`student_process`).

Independent of checks, scenarios and robots. This file imports nothing, because code inside and outside the arena
loads it.
"""
