"""What is done with definitions: they are built. No expected fields here: this runs in the arena."""

from __future__ import annotations

from autograder.arena.client_stage import ClientStage

PACKAGE = "my_interfaces"


def build(stage: ClientStage, file: str) -> None:
    """Build one of the files alone, so that a fault in one does not hide the other."""
    stage.run_module("ros_runtime.interface_build", [".", "/tmp/built", "--name", PACKAGE], [file])
