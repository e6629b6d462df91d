"""Action servers, and what is typed, as the checks write them down. This runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.arena import scripted_walk
from autograder.arena.client_stage import ClientStage
from autograder.arena.sequence import Steps


def in_order(
    stage: ClientStage, arguments: Sequence[str], server: scripted_walk.Server | None, steps: Steps
) -> None:
    """Offer `walk_to` by the script (None: nobody does), run the program, and carry out the steps."""
    scripted_walk.in_order(stage, arguments, server, steps)
