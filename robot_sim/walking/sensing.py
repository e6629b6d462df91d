"""The measured state for the walking controller, read once a tick into plain floats.

Views of MuJoCo's arrays are made once and turned into lists in bulk: indexing NumPy arrays element by element
costs more than the arithmetic done with the numbers.
"""

from __future__ import annotations

import math

import mujoco

from robot_sim.model.gravity import GRAVITY
from robot_sim.model.side import SIDES, Side
from robot_sim.walking.floor_slope import FloorSlope
from ros_runtime.angles import wrap


class Sensing:
    """The robot's state as its controller reads it, in the world frame.

    Args:
        data: the true or estimated state.
        measured: the true state, of which only the touch sensors are read.

    Attributes:
        com: centre of mass (x, y, z), m.
        com_velocity: (x, y, z), m/s.
        dcm: divergent component of motion (x, y), m: com + com_velocity / omega.
        omega: natural frequency of the linear inverted pendulum √(g/h), 1/s.
        ground: height of the floor under the supporting foot, m.
        slope: rise of the floor per m along x and y, measured by the soles.
        soles: centres of the two soles (x, y, z), m; left first.
        sole_rotations: their rotation matrices, row by row.
        foot_yaws: headings of the feet, rad.
        foot_loads: contact forces of the feet, N.
        feet_centre: (x, y, yaw) midway between the soles.
        pelvis, pelvis_rotation: position and rotation matrix (row by row) of base_link.
        base_velocity: linear in the world, angular in base_link: MuJoCo's six velocities of a free joint.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, measured: mujoco.MjData) -> None:
        pelvis = model.body("pelvis").id
        soles = _row_for_each_side([model.site(f"{side.letter}_sole").id for side in SIDES])
        loads = _row_for_each_side([model.sensor(f"{side.letter}_foot_touch").adr[0] for side in SIDES])
        root = model.joint("root").dofadr[0]
        self._com = data.subtree_com[pelvis]
        self._com_velocity = data.subtree_linvel[pelvis]
        self._loads = measured.sensordata[loads]
        self._soles, self._sole_rotations = data.site_xpos[soles], data.site_xmat[soles]
        self._pelvis = data.xpos[pelvis]
        self._pelvis_rotation = data.xmat[pelvis]
        self._base_velocity = data.qvel[root : root + 6]
        self._slope = FloorSlope(model.opt.timestep)
        self.read(swing_side=None)

    def read(self, swing_side: Side | None) -> None:
        """Read the present state; `swing_side` is the foot in the air, if any."""
        self.com = self._com.tolist()
        self.com_velocity = self._com_velocity.tolist()
        self.soles = self._soles.tolist()
        self.sole_rotations = self._sole_rotations.tolist()
        self.foot_loads = self._loads.tolist()
        self.foot_yaws = [math.atan2(rotation[3], rotation[0]) for rotation in self.sole_rotations]
        self.pelvis = self._pelvis.tolist()
        self.pelvis_rotation = self._pelvis_rotation.tolist()
        self.base_velocity = self._base_velocity.tolist()

        left, right = self.soles
        self.ground = min(left[2], right[2])
        if swing_side is not None:
            stance_side = swing_side.other
            self.ground = self.soles[stance_side][2]
            self._slope.update(self.sole_rotations[stance_side])
        self.slope = self._slope.estimate()
        self.omega = math.sqrt(GRAVITY / max(0.3, self.com[2] - self.ground))
        self.dcm = (
            self.com[0] + self.com_velocity[0] / self.omega,
            self.com[1] + self.com_velocity[1] / self.omega,
        )
        turn = wrap(self.foot_yaws[Side.RIGHT] - self.foot_yaws[Side.LEFT])
        self.feet_centre = (
            (left[0] + right[0]) / 2,
            (left[1] + right[1]) / 2,
            self.foot_yaws[Side.LEFT] + turn / 2,
        )


def _row_for_each_side(indices: list[int]) -> slice:
    """Return a slice that selects left and right; unlike a list of indices, it copies no data."""
    left, right = indices
    return slice(left, right + 1, right - left)
