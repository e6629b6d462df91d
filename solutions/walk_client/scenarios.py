"""Action servers, and what a person does, as the checks write them down. This runs in the arena."""

from __future__ import annotations

from typing import Any

from autograder.arena import scripted_walk
from autograder.arena.client_stage import ClientStage


def in_order(stage: ClientStage, **script: Any) -> None:
    """Carry out a script: `scripted_walk` says of what it consists."""
    scripted_walk.in_order(stage, **script)
