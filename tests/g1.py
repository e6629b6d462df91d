"""Whether the optional robot G1 is installed, for the tests of it."""

from __future__ import annotations

import pytest

from robot_sim.body import MissingParts, body_named


def _missing() -> str:
    try:
        body_named("g1")
    except MissingParts as error:
        return str(error)
    return ""


needs_g1 = pytest.mark.skipif(bool(_missing()), reason=_missing())
