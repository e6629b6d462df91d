"""Robots that are built once and then forked: each scenario's simulator begins with a fresh copy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


class Robots:
    """One robot for each set of options that a scenario needs; the simulator is imported only to build one."""

    def __init__(self) -> None:
        self._built: dict[tuple[str, ...], Any] = {}

    def build(self, options: Sequence[str]) -> None:
        """Build the robot for these options of `python -m robot_sim`, unless it was built before."""
        from robot_sim.ros.serve import build_humanoid, parse_options

        key = tuple(options)
        if key not in self._built:
            self._built[key] = build_humanoid(parse_options(options))

    def serve(self, options: Sequence[str], *more: str) -> None:
        """Run the robot until SIGINT or SIGTERM; `more` are options that need no other model."""
        from robot_sim.ros.serve import parse_options, serve_robot

        serve_robot(parse_options([*options, *more]), self._built[tuple(options)])
