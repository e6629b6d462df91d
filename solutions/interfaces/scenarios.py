"""The scenario builds a definition. No expected fields here: this runs in the arena."""

from __future__ import annotations

from autograder.arena.client_stage import ClientStage

PACKAGE = "my_interfaces"
PROCESSOR_TIME = 60  # s for each process of the build; the longest needs 5 s


def build(stage: ClientStage, file: str) -> None:
    """Build one of the files alone, so that a fault in one file does not hide a fault in the other."""
    limit = ["--processor-time", str(PROCESSOR_TIME)]
    stage.run_module("ros_runtime.interface_build", [".", "/tmp/built", "--name", PACKAGE, *limit], [file])
