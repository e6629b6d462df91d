"""What stands around the robot: nothing, a table with a cup, or a stand that holds it by the chest."""

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

STAND = """
<body name="stand">
  <geom class="visual" type="box" size="0.03 0.03 0.5" pos="-0.4 0 0.5" rgba="0.6 0.45 0.3 1"/>
  <geom class="visual" type="box" size="0.16 0.03 0.02" pos="-0.24 0 0.88" rgba="0.6 0.45 0.3 1"/>
</body>"""

SCENES = {"flat": "", "table": TABLE_AND_CUP, "stand": STAND}
OBJECTS = {"flat": (), "table": ("cup",), "stand": ()}  # what can be taken, by scene
HOLD_BY_THE_CHEST = "".join(
    f'<weld body1="{body}" body2="stand" solref="0.05 1"/>' for body in ("torso", "waist")
)
HOLDS = {"stand": HOLD_BY_THE_CHEST}  # what holds the robot, by scene


def scene_bodies(scene: str) -> str:
    """MJCF of the bodies of a scene ("flat", "table" or "stand"), the floor excepted.

    Raises:
        ValueError: the scene is not known; the message lists the known ones.
    """
    if scene not in SCENES:
        raise ValueError(f"scene {scene!r} is not known; choose one of {', '.join(map(repr, SCENES))}")
    return SCENES[scene]
