"""Events of a notebook other than those of its service and action clients."""

from __future__ import annotations

from dataclasses import dataclass

from ros_runtime.record.event import Event


@dataclass(frozen=True, kw_only=True)
class ModeChanged(Event):
    """The robot published another mode, a constant of humanoid_interfaces/RobotState."""

    mode: int


@dataclass(frozen=True, kw_only=True)
class GaveUp(Event):
    """The notebook gave up on a request; the caller had allowed `timeout` s."""

    timeout: float
