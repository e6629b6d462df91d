"""Repair rclpy in every process of the environment, when it imports a module that has a fault.

A .pth file calls `install` whenever Python starts. So this module imports nothing slow, and the repairs are imported
only after the program has imported rclpy. RCLPY_REPAIRS=off leaves rclpy unrepaired, which shows the faults.
"""

from __future__ import annotations

import os
import sys

STACK_FILE = "COURSE_STACK_FILE"  # variable with the descriptor of the file to which a program of the lab writes stacks
STACK_SIGNAL = 23  # SIGURG, which does not end a program without a handler

TYPE_CHECKING = False
if TYPE_CHECKING:  # typing itself takes a millisecond to import
    from collections.abc import Callable, Sequence
    from importlib.abc import Loader
    from importlib.machinery import ModuleSpec
    from types import ModuleType


def install() -> None:
    """Install finders that repair modules when they are imported; unset RMW_IMPLEMENTATION unless it is the default.

    A program of the lab also gets a handler that writes the stacks of its threads.

    A shell may set that variable for other ROS work. If its middleware is not installed, rcl ends the process at the
    import of rclpy. If it is installed, the course's nodes must still use the default middleware.
    """
    if os.environ.get("RMW_IMPLEMENTATION") not in (None, "rmw_fastrtps_cpp"):
        del os.environ["RMW_IMPLEMENTATION"]
    if descriptor := os.environ.pop(STACK_FILE, ""):
        import faulthandler

        faulthandler.register(STACK_SIGNAL, int(descriptor))
    if os.environ.get("RCLPY_REPAIRS") == "off":
        return
    for name, repair in (
        ("rclpy.executors", _repair_executors),
        ("rclpy.action.client", _repair_action_client),
        ("rclpy.event_handler", _repair_event_handler),
        ("rclpy.experimental.events_executor", _repair_events_executor),
    ):
        if name not in sys.modules:
            sys.meta_path.insert(0, _Finder(name, repair))


def _repair_executors(module: ModuleType) -> None:
    from ros_runtime.workarounds.rclpy_repairs import busy_executor, interrupt
    from ros_runtime.workarounds.rclpy_repairs.version import installed_version

    version = installed_version()
    for fault in (interrupt, busy_executor):
        if fault.needs_repair(version):
            fault.repair(module)


def _repair_action_client(module: ModuleType) -> None:
    from ros_runtime.workarounds.rclpy_repairs import lost_answers

    if lost_answers.needs_repair(module):
        lost_answers.repair(module)


def _repair_event_handler(module: ModuleType) -> None:
    from ros_runtime.workarounds.rclpy_repairs import destroyed_handler
    from ros_runtime.workarounds.rclpy_repairs.version import installed_version

    if destroyed_handler.needs_repair(installed_version()):
        destroyed_handler.repair(module)


def _repair_events_executor(module: ModuleType) -> None:
    from pathlib import Path

    from ros_runtime.workarounds.rclpy_repairs import endless_wait

    if endless_wait.needs_repair(Path(module._rclpy.__file__)):
        endless_wait.repair(module._rclpy)


class _Finder:
    """Finds one module, once, and makes its loader repair the module after loading it."""

    def __init__(self, name: str, repair: Callable[[ModuleType], None]) -> None:
        self._name = name
        self._repair = repair

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name != self._name:
            return None
        sys.meta_path.remove(self)
        from importlib.machinery import PathFinder

        spec = PathFinder.find_spec(name, path, target)
        if spec is not None and spec.loader is not None:
            _repair_after_loading(spec.loader, self._repair)
        return spec


def _repair_after_loading(loader: Loader, repair: Callable[[ModuleType], None]) -> None:
    load = loader.exec_module

    def exec_module(module: ModuleType) -> None:
        load(module)
        repair(module)

    loader.exec_module = exec_module  # type: ignore[method-assign]
