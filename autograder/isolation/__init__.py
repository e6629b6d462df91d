"""Processes that can do no harm: the arena (`arena_process`), the student's (`student_process`).

Knows nothing of checks, scenarios or robots. Kept free of imports, because both sides of the wall load it.
"""
