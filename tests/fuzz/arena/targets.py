"""The exercises for which generated programs are submitted: one of each kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Target:
    """An exercise for which a generated program is submitted.

    Attributes:
        exercise: its name.
        checks: the ids of those that judge it, including those they need; the last passes only if the task is solved.
        offers: what the exercise asks for: (service, action or client, name, type).
        correct: a known submission that passes them all.
    """

    exercise: str
    checks: Sequence[str]
    offers: Sequence[tuple[str, str, str]]
    correct: str


TARGETS: Mapping[str, Target] = {
    "arena-service": Target(
        "battery_service",
        ("server_appears", "answers_with_the_last_message"),
        (("service", "get_battery_status", "humanoid_interfaces/srv/GetBatteryStatus"),),
        "correct/class_based",
    ),
    "arena-action": Target(
        "cancellable_walk",
        ("server_appears", "accepts_a_goal", "arrives"),
        (("action", "walk_to", "humanoid_interfaces/action/WalkTo"),),
        "correct/threads_and_sleep",
    ),
    "arena-client": Target(
        "walk_client",
        ("sends_the_goal", "prints_the_feedback"),
        (("client", "walk_to", "humanoid_interfaces/action/WalkTo"),),
        "correct/one_loop",
    ),
    "arena-quiz": Target("patterns", ("answers_everything",), (), "correct/as_in_the_notebook"),
}
