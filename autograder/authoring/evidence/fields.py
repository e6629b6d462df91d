"""Compares fields of ROS messages with expected values."""

from __future__ import annotations

import math
from array import array
from functools import reduce
from numbers import Real
from typing import Any

import numpy as np

from autograder.authoring.failure import expect
from ros_runtime.messages import is_message

ROUNDING = 1e-5  # relative and absolute, of a number that was stored as float32
MAX_CHARACTERS = 200  # characters of a text that are shown


def expect_field(
    message: Any, path: str, value: Any, *, because: str, help: str, at: float | None = None, see: str = ""
) -> None:
    """Require that a field of a message has a value; NaN equals NaN.

    `path` is the field's name, such as "battery.percentage".

    Raises:
        Failure: it has another value, which is reported as observed.
    """
    observed = reduce(getattr, path.split("."), message)
    expect(
        same(observed, value),
        expected=f"{path}: {shown(value)}, because {because}",
        observed=f"{path}: {shown(observed)}",
        help=help,
        at=at,
        see=see,
    )


def same(observed: Any, value: Any) -> bool:
    """Return whether two values of a field are equal; numbers may differ by the rounding of a float32."""
    if _is_number(observed) and _is_number(value):
        both_nan = math.isnan(observed) and math.isnan(value)
        return both_nan or math.isclose(observed, value, rel_tol=ROUNDING, abs_tol=ROUNDING)
    return type(observed) is type(value) and observed == value


def differing_fields(observed: Any, expected: Any, *, path: str = "") -> list[str]:
    """Return the paths of the fields, such as "header.frame_id", in which two messages of one type differ."""
    if is_message(expected):
        return [
            each
            for name in expected.get_fields_and_field_types()
            for each in differing_fields(
                getattr(observed, name), getattr(expected, name), path=f"{path}.{name}" if path else name
            )
        ]
    if isinstance(expected, list | tuple | array | np.ndarray):
        alike = len(observed) == len(expected) and all(
            not differing_fields(one, other) for one, other in zip(observed, expected, strict=True)
        )
    else:
        alike = same(observed, expected)
    return [] if alike else [path or "value"]


def shown(value: Any) -> str:
    """Return a value as ROS's tools print it."""
    if isinstance(value, bool):
        return str(value).lower()
    if _is_number(value):
        return "NaN" if math.isnan(value) else str(value) if isinstance(value, int) else f"{value:g}"
    if is_message(value):
        return f"{{{shown_fields(value, *value.get_fields_and_field_types())}}}"
    return repr(value[:MAX_CHARACTERS] if isinstance(value, str) else value)


def shown_fields(message: Any, *names: str) -> str:
    """Return some fields of a message: 'success: true, message: "…"'."""
    return ", ".join(f"{name}: {shown(getattr(message, name))}" for name in names)


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)
