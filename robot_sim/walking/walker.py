"""The walking controller: read the state, update the gait, command the motors."""

from __future__ import annotations

import mujoco

from robot_sim.walking.balance_gains import BalanceGains, Trunk
from robot_sim.walking.footsteps import Command
from robot_sim.walking.gait import Gait, Phase
from robot_sim.walking.sensing import Sensing
from robot_sim.walking.walker_parameters import WalkerParameters
from robot_sim.walking.whole_body import WholeBody


class Walker:
    """The controller that balances and walks a humanoid; make a new one whenever the state in `data` was replaced.

    Args:
        data: the simulation, with the motors and touch sensors.
        state: the state that the controller reads; `data` itself unless the state is estimated.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        state: mujoco.MjData,
        trunk: Trunk,
        parameters: WalkerParameters,
    ) -> None:
        self.gait = Gait(parameters)
        self.sensed = Sensing(model, state, data)
        self._whole_body = WholeBody(model, state, data.ctrl, trunk, parameters)

    @property
    def stands(self) -> bool:
        """Whether both feet stand and no step is planned."""
        return self.gait.phase is Phase.STAND

    @property
    def is_idle(self) -> bool:
        """Whether both feet stand without a command to walk."""
        return self.stands and self.gait.is_idle

    @property
    def steps(self) -> int:
        """Touchdowns so far."""
        return self.gait.steps

    @property
    def goal_reached(self) -> bool:
        """Whether the last Goal was reached and no command has come since."""
        return self.gait.goal_reached

    @property
    def height(self) -> float:
        """Height of the pelvis above the floor that is held, m."""
        return self._whole_body.height

    @height.setter
    def height(self, height: float) -> None:
        self._whole_body.height = height

    @property
    def gains(self) -> BalanceGains:
        """How stiffly the trunk is held upright."""
        return self._whole_body.gains

    @gains.setter
    def gains(self, gains: BalanceGains) -> None:
        self._whole_body.gains = gains

    def follow(self, command: Command) -> None:
        """Walk to a Goal or at a Velocity; None stops."""
        self.gait.follow(command)

    def tick(self, dt: float) -> None:
        """Set the leg motors for the next `dt` (s); call it between `mj_step1` and `mj_step2`."""
        self.sensed.read(self.gait.swing_side)
        task = self.gait.update(self.sensed, self._whole_body.cop_shift, dt)
        self._whole_body.command(task, self.sensed, dt)
