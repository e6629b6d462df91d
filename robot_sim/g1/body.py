"""The G1 as one kind of robot, and the files of other packages that it is made of."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import mujoco

from robot_sim.body import Body, MissingParts
from robot_sim.g1.model import g1_model
from robot_sim.g1.walker import STANCE, LearnedWalker, Policy
from robot_sim.walking.body_height import HeightLimits
from robot_sim.walking.walking_limits import WalkingLimits
from ros_runtime.project import PROJECT

PARTS = {  # each package that is needed, and the file that is read there
    "onnxruntime": "__init__.py",
    "holosoma_inference": "models/loco/g1_29dof/ppo_g1_29dof.onnx",
    "mujoco_playground": "_src/locomotion/g1/xmls/g1_mjx_feetonly.xml",
}
STANCE_HEIGHT = 0.76  # m


class G1Body(Body):
    """The Unitree G1 with 29 joints, all of which its walker moves: no arm, hand or crouch can be commanded.

    Raises:
        MissingParts: the packages of the extra `g1` are not installed.
    """

    name = "g1"
    scenes = ("flat",)
    movable = ()
    hands = ()
    limits = WalkingLimits(forward=0.45, backward=0.28, sideways=0.12, turn=0.6)
    heights = HeightLimits(lowest=STANCE_HEIGHT)
    fallen_height = 0.5
    may_rest = False  # its walker moves the joints a little even while it stands

    def __init__(self) -> None:
        self._model_file = _part("mujoco_playground")
        _part("onnxruntime")
        self._policy = _policy(_part("holosoma_inference"))
        self.joints = self._policy.joints

    def model(self, scene: str, shape: Callable[[mujoco.MjSpec], object]) -> mujoco.MjModel:
        """Compile the robot on a flat floor; `shape` is called with the model before."""
        if scene not in self.scenes:
            raise ValueError(f"the G1 has no scene {scene!r}; it has {', '.join(self.scenes)}")
        model = g1_model(self._model_file, shape)
        self._policy.set_servos(model)
        return model

    def stance_height(self, model: mujoco.MjModel) -> float:
        """Return the height (m) of the pelvis above the floor while it stands."""
        return STANCE_HEIGHT

    def take_stance(
        self, model: mujoco.MjModel, data: mujoco.MjData, x: float, y: float, yaw: float, height: float
    ) -> None:
        """Reset the state to standing with the pelvis at (x, y, height) m, heading `yaw` rad, servos holding."""
        mujoco.mj_resetData(model, data)
        data.qpos[:7] = [x, y, height, math.cos(yaw / 2), 0, 0, math.sin(yaw / 2)]
        data.qpos[7:] = data.ctrl[:] = STANCE
        mujoco.mj_forward(model, data)

    def walker(self, model: mujoco.MjModel, data: mujoco.MjData) -> LearnedWalker:
        """Make the controller that starts from the present state."""
        return LearnedWalker(model, data, self._policy, STANCE_HEIGHT)


def _part(package: str) -> Path:
    """Return the file of a package that is needed, without importing the package, which would need many others."""
    found = find_spec(package)
    file = Path(found.submodule_search_locations[0]) / PARTS[package] if found else None  # type: ignore[index]
    if file is None or not file.is_file():
        raise MissingParts(
            f"the G1 needs {package}, which is not installed (Python 3.11 or newer); "
            f"type:  bash {PROJECT / 'setup' / 'install_g1.sh'}"
        )
    return file


@cache
def _policy(file: Path) -> Policy:
    return Policy(file)
