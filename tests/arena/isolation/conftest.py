from __future__ import annotations

import pytest

from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import available_isolation

WITH_NAMESPACES = pytest.mark.skipif(
    not available_isolation().trusted, reason=f"no namespaces here: {available_isolation().reason}"
)


@pytest.fixture(
    params=[pytest.param(Kind.NAMESPACES, marks=WITH_NAMESPACES), Kind.NONE], ids=lambda kind: kind.value
)
def kind(request: pytest.FixtureRequest) -> Kind:
    """Every kind of arena this machine offers, one after the other."""
    return request.param


@pytest.fixture(params=[pytest.param(Kind.NAMESPACES, marks=WITH_NAMESPACES)], ids=lambda kind: kind.value)
def namespaces(request: pytest.FixtureRequest) -> Kind:
    """The kind that isolates."""
    return request.param
