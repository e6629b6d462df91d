"""Scenarios with a scripted action server and a scripted person; the checks supply the scripts."""

from __future__ import annotations

from typing import Any

from autograder.arena import scripted_walk
from autograder.arena.client_stage import ClientStage


def in_order(stage: ClientStage, **script: Any) -> None:
    """Carry out a script; `scripted_walk` documents its parts."""
    scripted_walk.in_order(stage, **script)
