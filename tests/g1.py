"""The robots to test with; the optional G1 is left out, with the reason, where its packages are not installed."""

from __future__ import annotations

import pytest

from robot_sim.body import MissingParts, body_named

try:
    body_named("g1")
    _missing = ""
except MissingParts as error:
    _missing = str(error)

needs_g1 = pytest.mark.skipif(bool(_missing), reason=_missing)
ROBOTS = ("humanoid", pytest.param("g1", marks=needs_g1))
