"""What every walking controller offers."""

from __future__ import annotations

from abc import ABC, abstractmethod

from robot_sim.walking.balance_gains import BalanceGains
from robot_sim.walking.footsteps import Command


class WalkingController(ABC):
    """What balances and walks a robot; a new one is made whenever the state of the simulation was replaced."""

    @property
    @abstractmethod
    def stands(self) -> bool:
        """Whether both feet stand and no step is planned."""

    @property
    @abstractmethod
    def is_idle(self) -> bool:
        """Whether both feet stand without a command to walk, so that the robot may rest."""

    @property
    @abstractmethod
    def steps(self) -> int:
        """Touchdowns so far."""

    @property
    @abstractmethod
    def goal_reached(self) -> bool:
        """Whether the last Goal was reached and no command has come since."""

    @property
    @abstractmethod
    def height(self) -> float:
        """Height of the pelvis above the floor that is held, m."""

    @height.setter
    @abstractmethod
    def height(self, height: float) -> None: ...

    @property
    @abstractmethod
    def gains(self) -> BalanceGains | None:
        """How stiffly the trunk is held upright; None if that cannot be set."""

    @gains.setter
    @abstractmethod
    def gains(self, gains: BalanceGains | None) -> None: ...

    @abstractmethod
    def follow(self, command: Command) -> None:
        """Walk to a Goal or at a Velocity; None stops."""

    @abstractmethod
    def tick(self, dt: float) -> None:
        """Set the motors for the next `dt` (s); call it between `mj_step1` and `mj_step2`."""
