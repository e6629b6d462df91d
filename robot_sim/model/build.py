"""The MuJoCo model of the humanoid in its scene."""

from __future__ import annotations

import mujoco

from robot_sim.model.floor import Floor
from robot_sim.model.scenes import scene_file


def build_model(
    scene: str = "flat", *, timestep: float = 0.005, floor: Floor | None = None
) -> mujoco.MjModel:
    """Compile the humanoid of `humanoid.xml` standing in `scene`.

    Args:
        scene: "flat", "table" or "stand".
        timestep: of the simulation, s.
        floor: what it stands on; a level plane unless given.

    Raises:
        ValueError: the scene is not known.
    """
    spec = mujoco.MjSpec.from_file(str(scene_file(scene)))
    spec.option.timestep = timestep
    (floor or Floor()).shape(spec)
    return spec.compile()
