"""What is done with definitions: they are built. No expected fields here: this runs in the arena."""

from __future__ import annotations

from autograder.arena.client_stage import ClientStage

PACKAGE = "my_interfaces"
PROCESSOR_TIME = 60  # s for each process of the build, of which the longest needs five


def build(stage: ClientStage, file: str) -> None:
    """Build one of the files alone, so that a fault in one does not hide the other."""
    limit = ["--processor-time", str(PROCESSOR_TIME)]
    stage.run_module("ros_runtime.interface_build", [".", "/tmp/built", "--name", PACKAGE, *limit], [file])
