"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from autograder.authoring import Transcript, check

from .checks import ACTION, SERVICE, action_builds, service_builds
from .judging import require_constants, require_fields

ERROR_CODES = {"NONE": 0, "FELL": 1, "PREEMPTED": 2, "TIMEOUT": 3}


@check(on=SERVICE, needs=service_builds, see="04_your_own_interfaces#anatomy", clauses=[1])
def request_is_empty(run: Transcript) -> None:
    """The request of GetBatteryStatus is empty"""
    require_fields(run, "request", {})


@check(points=2, on=ACTION, needs=action_builds, see="04_your_own_interfaces#anatomy", clauses=[6])
def error_codes_have_names(run: Transcript) -> None:
    """The result has named constants for the error codes 0 to 3"""
    require_constants(run, "result", "uint16", ERROR_CODES)
