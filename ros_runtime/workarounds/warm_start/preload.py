"""Loads what nearly every node needs, and nothing that starts a thread or a participant."""

from __future__ import annotations

import ctypes
import importlib
from contextlib import suppress

MODULES = (
    *("rclpy", "rclpy.node", "rclpy.action", "rclpy.executors", "rclpy.callback_groups", "rclpy.qos"),
    *("rclpy.duration", "rclpy.parameter", "rclpy.time", "rclpy.task", "rclpy.signals"),
    *("action_msgs.msg", "action_msgs.srv", "builtin_interfaces.msg", "geometry_msgs.msg", "nav_msgs.msg"),
    *("rcl_interfaces.msg", "rcl_interfaces.srv", "rosgraph_msgs.msg", "sensor_msgs.msg", "std_msgs.msg"),
    *("std_srvs.srv", "trajectory_msgs.msg", "unique_identifier_msgs.msg"),
    *("humanoid_interfaces.msg", "humanoid_interfaces.srv", "humanoid_interfaces.action"),
    *("numpy", "math", "threading", "time", "json", "argparse", "contextlib", "dataclasses"),
)
_PACKAGES = sorted({name.split(".")[0] for name in MODULES if name.endswith((".msg", ".srv", ".action"))})
# Loaded by name when the first node, publisher or service is made.
LIBRARIES = (
    "librmw_fastrtps_cpp.so",
    *(
        f"lib{package}__{kind}.so"
        for package in (*_PACKAGES, "service_msgs", "type_description_interfaces")
        for kind in (
            "rosidl_typesupport_c",
            "rosidl_typesupport_fastrtps_c",
            "rosidl_typesupport_fastrtps_cpp",
            "rosidl_generator_py",
        )
    ),
)


def preload() -> None:
    """Load the modules, except those that are not installed."""
    for name in MODULES:
        with suppress(ImportError):
            importlib.import_module(name)
    for library in LIBRARIES:
        with suppress(OSError):
            ctypes.CDLL(library)
