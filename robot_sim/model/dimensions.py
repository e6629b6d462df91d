"""The lengths of the body that the controller needs."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco


@dataclass(frozen=True, slots=True)
class Dimensions:
    """Lengths in m, as `humanoid.xml` has them; both sides are alike."""

    stance_height: float  # pelvis above the floor
    thigh: float  # hip to knee
    shank: float  # knee to ankle
    ankle_height: float  # ankle axes above the sole
    sole_half_length: float
    sole_half_width: float


def dimensions_of(model: mujoco.MjModel) -> Dimensions:
    """Read the dimensions of a humanoid from its model."""
    half_length, half_width, _ = model.geom("l_sole").size.tolist()
    return Dimensions(
        stance_height=model.body("pelvis").pos[2].item(),
        thigh=-model.body("l_shank").pos[2].item(),
        shank=-model.body("l_ankle_link").pos[2].item(),
        ankle_height=-model.site("l_sole").pos[2].item(),
        sole_half_length=half_length,
        sole_half_width=half_width,
    )
