"""Repair rclpy in every process of the environment, when it imports rclpy.executors.

A .pth file calls `install` whenever Python starts. So this module imports nothing that costs time, and rclpy
only when the program does. RCLPY_REPAIRS=off leaves rclpy as it is, to see the fault.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:  # typing itself takes a millisecond to import
    from collections.abc import Sequence
    from importlib.abc import Loader
    from importlib.machinery import ModuleSpec
    from types import ModuleType

MODULE = "rclpy.executors"


def install() -> None:
    """Watch for the import of rclpy.executors."""
    if os.environ.get("RCLPY_REPAIRS") != "off" and MODULE not in sys.modules:
        sys.meta_path.insert(0, _Finder())


class _Finder:
    """Finds nothing but one module, once, and has its loader repair what it loaded."""

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name != MODULE:
            return None
        sys.meta_path.remove(self)
        from importlib.machinery import PathFinder

        spec = PathFinder.find_spec(name, path, target)
        if spec is not None and spec.loader is not None:
            _repair_after_loading(spec.loader)
        return spec


def _repair_after_loading(loader: Loader) -> None:
    load = loader.exec_module

    def exec_module(module: ModuleType) -> None:
        load(module)
        from ros_runtime.workarounds.rclpy_repairs import busy_executor, interrupt
        from ros_runtime.workarounds.rclpy_repairs.version import installed_version

        version = installed_version()
        for fault in (interrupt, busy_executor):
            if fault.needs_repair(version):
                fault.repair(module)

    loader.exec_module = exec_module  # type: ignore[method-assign]
