"""The surroundings in which rclpy's tests run: as rclpy is, and with one more thing of the course each time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ros_runtime.environment import ros_environment
from ros_runtime.ros_domain import loopback_variables
from ros_runtime.workarounds.scaled_clock import ScaledClock, library_path

_LIBRARIES = ("LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE")


@dataclass(frozen=True)
class Mode:
    """One column of the table.

    Attributes:
        repaired: rclpy has the course's repairs.
        scale: of the arena's clock; None: the processes do not follow one.
    """

    name: str
    repaired: bool
    scale: float | None = None

    def environment(self, folder: Path, domain_id: int) -> dict[str, str]:
        """The variables to add to a process's environment; a clock's page is made in `folder`.

        Common to all: where rclpy's libraries are, and a ROS domain of its own on the loopback interface, without which
        two files that run side by side would hear each other. Not what the course sets for students' nodes besides:
        ROS_PYTHON_CHECK_FIELDS refuses some messages of test_parameter_event_handler.py, and is there to do so.
        """
        course = ros_environment()
        common = {name: course[name] for name in _LIBRARIES if name in course}
        common |= {**loopback_variables(), "ROS_DOMAIN_ID": str(domain_id)}
        if not self.repaired:
            return common | {"RCLPY_REPAIRS": "off"}
        if self.scale is None:
            return common
        clock = ScaledClock.create(folder / "clock")
        clock.run_at(self.scale)
        return common | clock.environment()


PLAIN = Mode("plain", repaired=False)
REPAIRED = Mode("repaired", repaired=True)
_ON_THE_CLOCK = (Mode("clock at 1", repaired=True, scale=1.0), Mode("clock at 5", repaired=True, scale=5.0))


def available_modes() -> tuple[Mode, ...]:
    """Those that this environment can offer: without the clock's library there is no clock."""
    return (PLAIN, REPAIRED, *(_ON_THE_CLOCK if library_path() else ()))
