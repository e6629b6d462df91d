"""The force and torque that the floor exerts on a foot."""

from __future__ import annotations

import mujoco
import numpy as np

from robot_sim.model.side import Side
from robot_sim.state import Wrench


class FootSensor:
    """The force-torque sensor in a foot, which measures the sum of all contacts of the foot."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, side: Side) -> None:
        self._model, self._data = model, data
        self._foot = model.body(f"{side.letter}_foot").id
        sole = data.site(f"{side.letter}_sole")
        self._centre, self._axes = sole.xpos, sole.xmat

    def read(self) -> Wrench:
        """Return the present wrench."""
        contacts = self._data.contact
        bodies = self._model.geom_bodyid[contacts.geom]
        mine = np.flatnonzero((bodies == self._foot).any(axis=1))
        felt = np.empty((len(mine), 6))
        for row, contact in enumerate(mine.tolist()):
            mujoco.mj_contactForce(self._model, self._data, contact, felt[row])
        felt[
            bodies[mine, 1] != self._foot
        ] *= -1.0  # MuJoCo returns the force on the second body of a contact
        axes = contacts.frame[mine].reshape(-1, 3, 3)
        forces = np.einsum("ci,cij->cj", felt[:, :3], axes)
        torques = np.einsum("ci,cij->cj", felt[:, 3:], axes)
        torques += np.cross(contacts.pos[mine] - self._centre, forces)
        to_sole = self._axes.reshape(3, 3)
        return Wrench(forces.sum(axis=0) @ to_sole, torques.sum(axis=0) @ to_sole)
