"""Repair of rclpy's QoS event handlers, which end a spin when another thread destroys a publisher or subscription.

What happens. One thread spins and another one destroys a subscription. Rarely, on a busy machine more often, spin()
raises InvalidHandle, "cannot use Destroyable because destruction was requested", and the node runs no more callbacks.

Why. The executor collects the event handlers and enters those that still exist. But then it adds every collected one
to its wait set, and takes the data of each that was ready. A handler that was destroyed meanwhile raises in both.

The repair. A destroyed handler is not added to the wait set, so it is never ready, and has no data.
"""

from __future__ import annotations

from contextlib import suppress
from types import ModuleType
from typing import Any

from ros_runtime.workarounds.rclpy_repairs.version import numbers

FIRST_AFFECTED = (7, 1, 0)
# Jazzy has 7.1; later versions were not examined.
FIRST_UNKNOWN = (7, 2, 0)


def needs_repair(version: str) -> bool:
    """Return whether the event handlers of this version of rclpy have the fault."""
    return FIRST_AFFECTED <= numbers(version) < FIRST_UNKNOWN


def repair(event_handler: ModuleType) -> None:
    """Change the class EventHandler of the module rclpy.event_handler in place."""
    cls, invalid_handle = event_handler.EventHandler, event_handler._rclpy.InvalidHandle
    add_to_wait_set, take_data = cls.add_to_wait_set, cls.take_data

    def add_unless_destroyed(self: Any, wait_set: Any) -> None:
        self._event_index = None
        with suppress(invalid_handle):
            add_to_wait_set(self, wait_set)

    def take_unless_destroyed(self: Any) -> Any:
        try:
            return take_data(self)
        except invalid_handle:
            return None

    cls.add_to_wait_set, cls.take_data = add_unless_destroyed, take_unless_destroyed
