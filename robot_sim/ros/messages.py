"""Small helpers for ROS messages and publishers."""

from __future__ import annotations

from array import array
from collections.abc import Iterable
from typing import Any

import numpy as np
from rclpy.publisher import Publisher


def floats(values: np.ndarray) -> array[float]:
    """Return numbers as an array, which a message accepts without checking each number."""
    return array("d", values.tobytes())


def has_subscribers(publisher: Publisher) -> bool:
    """Return whether a publisher has subscribers; without them no message needs to be made."""
    return publisher.get_subscription_count() > 0


def set_fields(message: Any, fields: str, values: Iterable[float]) -> None:
    """Set the fields named by single letters, such as "xyz", to numbers of any kind."""
    for field, value in zip(fields, values, strict=True):
        setattr(message, field, float(value))
