"""What stands around the robot: nothing, or a table with a cup."""

TABLE_AND_CUP = """
<body name="table" pos="0.42 0 0">
  <geom name="table_top" class="furniture" type="box" size="0.18 0.4 0.015" pos="0 0 0.685"/>
  <geom class="furniture" type="box" size="0.03 0.03 0.335" pos="0.13 0.35 0.335"/>
  <geom class="furniture" type="box" size="0.03 0.03 0.335" pos="0.13 -0.35 0.335"/>
</body>
<body name="cup" pos="0.33 -0.15 0.755">
  <freejoint name="cup"/>
  <geom name="cup" type="cylinder" size="0.03 0.055" mass="0.3" rgba="0.85 0.2 0.2 1"
        contype="1" conaffinity="1" condim="4" friction="1 0.01 0.0001"/>
</body>"""

SCENES = {"flat": "", "table": TABLE_AND_CUP}
OBJECTS = {"flat": (), "table": ("cup",)}  # what can be taken, by scene


def scene_bodies(scene: str) -> str:
    """MJCF of the bodies of a scene ("flat" or "table"), the floor excepted.

    Raises:
        ValueError: the scene is not known; the message lists the known ones.
    """
    if scene not in SCENES:
        raise ValueError(f"scene {scene!r} is not known; choose one of {', '.join(map(repr, SCENES))}")
    return SCENES[scene]
