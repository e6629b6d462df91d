"""The scenes of the robot: a flat floor, a table with a cup, or a stand that holds it by the chest."""

from __future__ import annotations

from pathlib import Path

SCENES = {"flat": "humanoid.xml", "table": "table.xml", "stand": "stand.xml"}  # files beside this one
OBJECTS = {"flat": (), "table": ("cup",), "stand": ()}  # objects that the robot can take, by scene


def scene_file(scene: str) -> Path:
    """Return the MJCF file of a scene ("flat", "table" or "stand") with the robot in it.

    Raises:
        ValueError: the scene is not known; the message lists the known ones.
    """
    if scene not in SCENES:
        raise ValueError(f"scene {scene!r} is not known; choose one of {', '.join(map(repr, SCENES))}")
    return Path(__file__).with_name(SCENES[scene])
