"""The Unitree G1 as one kind of robot, and the files of other packages that it is made of."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import mujoco
from mujoco import MjData, MjModel

from robot_sim.body import Body, MissingParts
from robot_sim.g1.model import STANCE_HEIGHT, g1_model
from robot_sim.g1.walker import STANCE, LearnedWalker, Policy
from robot_sim.walking.body_height import HeightLimits
from robot_sim.walking.walking_limits import WalkingLimits
from ros_runtime.project import PROJECT

PARTS = {  # each package that is needed, and the file that is read there
    "onnxruntime": "__init__.py",
    "holosoma_inference": "models/loco/g1_29dof/ppo_g1_29dof.onnx",
    "mujoco_playground": "_src/locomotion/g1/xmls/g1_mjx_feetonly.xml",
}


@cache
def g1_body() -> Body:
    """Return the G1. Its walker moves all joints, so no arm, hand or crouch can be commanded, and it never rests.

    Raises:
        MissingParts: the packages of the extra `g1` are not installed.
    """
    _, network, model_file = (part_of(package) for package in PARTS)
    policy = Policy(network)

    def model_in(scene: str, shape: Callable[[Any], object]) -> MjModel:
        if scene != "flat":
            raise ValueError(f"the G1 has no scene {scene!r}; it has flat")
        model = g1_model(model_file, shape)
        policy.set_servos(model)
        return model

    return Body(
        name="g1",
        limits=WalkingLimits(forward=0.45, backward=0.28, sideways=0.12, turn=0.6),
        heights=HeightLimits(lowest=STANCE_HEIGHT),
        fallen_height=0.5,
        still_speed=0.12,
        model=model_in,
        take_stance=_take_stance,
        walker=lambda model, data: LearnedWalker(model, data, policy),
    )


def part_of(package: str) -> Path:
    """Return the file that is read in a package, without importing the package, which would need many others.

    Raises:
        MissingParts: the package is not installed.
    """
    found = find_spec(package)
    folders = found.submodule_search_locations if found else None
    if not folders:
        raise MissingParts(
            f"the G1 needs {package}, which is not installed (Python 3.11 or newer); "
            f"type:  bash {PROJECT / 'setup' / 'install_g1.sh'}"
        )
    return Path(folders[0]) / PARTS[package]


def _take_stance(model: MjModel, data: MjData, x: float, y: float, yaw: float, height: float) -> None:
    mujoco.mj_resetData(model, data)
    data.qpos[:7] = [x, y, height, math.cos(yaw / 2), 0, 0, math.sin(yaw / 2)]
    data.qpos[7:] = data.ctrl[:] = STANCE
    mujoco.mj_forward(model, data)
