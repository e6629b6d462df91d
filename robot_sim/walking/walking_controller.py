"""What every walking controller offers."""

from __future__ import annotations

from typing import Protocol

from robot_sim.walking.balance_gains import BalanceGains
from robot_sim.walking.footsteps import Command


class WalkingController(Protocol):
    """What balances and walks a robot; a new one is made whenever the state of the simulation was replaced.

    Attributes:
        stands: both feet stand and no step is planned.
        is_idle: so does the whole robot, without a command.
        steps: touchdowns so far.
        goal_reached: the last Goal was reached and no command has come since.
        height: of the pelvis above the floor that is held, m.
        gains: how stiffly the trunk is held upright; None if that cannot be set.
    """

    height: float

    @property
    def stands(self) -> bool: ...  # noqa: D102
    @property
    def is_idle(self) -> bool: ...  # noqa: D102
    @property
    def steps(self) -> int: ...  # noqa: D102
    @property
    def goal_reached(self) -> bool: ...  # noqa: D102
    @property
    def gains(self) -> BalanceGains | None: ...  # noqa: D102
    @gains.setter
    def gains(self, gains: BalanceGains | None) -> None: ...

    def follow(self, command: Command) -> None:
        """Walk to a Goal or at a Velocity; None stops."""

    def tick(self, dt: float) -> None:
        """Set the motors for the next `dt` (s); it is called between `mj_step1` and `mj_step2`."""
