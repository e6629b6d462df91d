"""The battery: charge, voltage and current, computed from the power of motors and electronics."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

CURRENT_TIME_CONSTANT = 0.5  # s, of the low-pass in the current sensor


@dataclass(frozen=True, slots=True)
class BatteryParameters:
    """A pack of lithium cells in series and the robot's consumption."""

    cells: int = 8
    capacity: float = 120.0  # W·h
    full_voltage: float = 33.6  # V, open circuit
    empty_voltage: float = 25.6  # V, open circuit
    resistance: float = 0.05  # Ω
    idle_power: float = 18.0  # W, computers and sensors
    motor_loss: float = 0.025  # W/(N·m)², heat in the windings' resistance

    @property
    def design_charge(self) -> float:
        """The charge of a full pack, A·h."""
        return 2 * self.capacity / (self.full_voltage + self.empty_voltage)


class Battery:
    """A lithium pack whose voltage falls with its charge and under load.

    Attributes:
        percentage: charge, 0 to 1.
        pack: the pack's serial number, from 1.
        energy_used: J, since this object was made.
    """

    def __init__(self) -> None:
        self.parameters = BatteryParameters()
        self.percentage = 1.0
        self.pack = 1
        self.energy_used = 0.0
        self._power = self._latest_power = self.parameters.idle_power

    @property
    def current(self) -> float:
        """Current in A, negative because the pack only discharges (sign as in sensor_msgs/BatteryState).

        The discharge current I solves: power drawn = (open-circuit voltage - resistance · I) · I.
        """
        voltage, resistance = self._open_circuit_voltage(), self.parameters.resistance
        return -(voltage - math.sqrt(voltage**2 - 4 * resistance * self._power)) / (2 * resistance)

    @property
    def voltage(self) -> float:
        """Voltage at the terminals, V."""
        return self._open_circuit_voltage() + self.parameters.resistance * self.current

    @property
    def is_empty(self) -> bool:
        """Whether no charge is left."""
        return self.percentage <= 0.0

    def set_percentage(self, percentage: float) -> None:
        """Replace the pack by one with this charge (0 to 1).

        Raises:
            ValueError: the percentage is not within 0 and 1.
        """
        if not 0.0 <= percentage <= 1.0:
            raise ValueError(f"percentage is {percentage}; expected 0 (empty) to 1 (full)")
        self.percentage = float(percentage)
        self.pack += 1

    def drain(self, torque: np.ndarray, velocity: np.ndarray, dt: float) -> None:
        """Discharge by the energy that motors and electronics draw in one timestep.

        A motor draws its mechanical power while it drives (braking recovers nothing), and the heat of
        its windings, I²R, which is proportional to the torque squared.

        Args:
            torque: of every motor, N·m.
            velocity: of every motor, rad/s.
            dt: the timestep, s.
        """
        work = torque * velocity
        power = float(work @ (work > 0.0) + self.parameters.motor_loss * (torque @ torque))
        self.discharge(power + self.parameters.idle_power, dt)

    def drain_as_before(self, dt: float) -> None:
        """Draw the power of the last timestep for `dt` (s)."""
        self.discharge(self._latest_power, dt)

    def discharge(self, power: float, dt: float) -> None:
        """Draw `power` (W) for `dt` (s)."""
        self._latest_power = power
        energy = power * dt
        self.energy_used += energy
        self.percentage = max(0.0, self.percentage - energy / (self.parameters.capacity * 3600))
        self._power += (power - self._power) * min(1.0, dt / CURRENT_TIME_CONSTANT)

    def _open_circuit_voltage(self) -> float:
        full, empty = self.parameters.full_voltage, self.parameters.empty_voltage
        return empty + self.percentage * (full - empty)
