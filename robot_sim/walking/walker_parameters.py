"""The parameters of the walking controller."""

from __future__ import annotations

from dataclasses import dataclass, field

from robot_sim.model.dimensions import Dimensions
from robot_sim.walking.balance_parameters import BalanceParameters
from robot_sim.walking.foot_tipping import TippingParameters
from robot_sim.walking.gait_parameters import GaitParameters, StepLimits


@dataclass(frozen=True, slots=True)
class WalkerParameters:
    """The body's dimensions and the parameters of each part of the controller."""

    dimensions: Dimensions
    steps: StepLimits = field(default_factory=StepLimits)
    gait: GaitParameters = field(default_factory=GaitParameters)
    balance: BalanceParameters = field(default_factory=BalanceParameters)
    tipping: TippingParameters = field(default_factory=TippingParameters)
