"""A clock that a whole arena shares and that can run faster than real time."""

from ros_runtime.workarounds.scaled_clock.clock import ScaledClock, library_path

__all__ = ["ScaledClock", "library_path"]
