"""The MuJoCo model of the humanoid in its scene."""

from __future__ import annotations

from collections.abc import Callable

import mujoco

from robot_sim.model.scenes import scene_file

TIMESTEP = 0.005  # s, of physics and controller


def build_model(
    scene: str = "flat",
    *,
    shape: Callable[[mujoco.MjSpec], object] = lambda spec: None,
) -> mujoco.MjModel:
    """Compile the humanoid of `humanoid.xml` standing in `scene`.

    Args:
        scene: "flat", "table" or "stand".
        shape: called with the model before it is compiled, to change it.

    Raises:
        ValueError: the scene is not known.
    """
    spec = mujoco.MjSpec.from_file(str(scene_file(scene)))
    spec.option.timestep = TIMESTEP
    shape(spec)
    return spec.compile()
