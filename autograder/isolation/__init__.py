"""Processes that can do no harm: the arena (:mod:`.arena_process`), the student's (:mod:`.student_process`).

Knows nothing of checks, scenarios or robots. Kept free of imports, because both sides of the wall load it.
"""
