"""The scenario runs the program that prints the answers. No right answers here: this runs in the arena."""

from __future__ import annotations

from autograder.arena.client_stage import ClientStage


def print_answers(stage: ClientStage) -> None:
    """Run the program until it exits."""
    stage.start_program()
    stage.wait_for_end()
