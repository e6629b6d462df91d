"""The MuJoCo model of the humanoid in its scene."""

from __future__ import annotations

from collections.abc import Callable

import mujoco

from robot_sim.model.scenes import scene_file


def build_model(
    scene: str = "flat",
    *,
    timestep: float = 0.005,
    shape: Callable[[mujoco.MjSpec], object] = lambda spec: None,
) -> mujoco.MjModel:
    """Compile the humanoid of `humanoid.xml` standing in `scene`.

    Args:
        scene: "flat", "table" or "stand".
        timestep: of the simulation, s.
        shape: called with the model before it is compiled, to change it.

    Raises:
        ValueError: the scene is not known.
    """
    spec = mujoco.MjSpec.from_file(str(scene_file(scene)))
    spec.option.timestep = timestep
    shape(spec)
    return spec.compile()
