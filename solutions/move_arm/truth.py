"""Where the arms' joints were, from the simulator's reports that the scenario requested with `report_joints`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.authoring import Goal, RobotRecord, ev, why_no_message_arrives

from .plan import Plan, errors, largest

_ACCEPT = (
    "goal_callback must return GoalResponse.ACCEPT for a valid trajectory (True is not GoalResponse.ACCEPT). To "
    "receive the ranges, subscribe to joint_limits with DurabilityPolicy.TRANSIENT_LOCAL: it is published only once."
)


def require_accepted(goal: Goal) -> Goal:
    """Require that the server accepted the goal."""
    causes = (why_no_message_arrives(goal.run, topic) for topic in ("joint_limits", "joint_states"))
    return goal.require_accepted(next(filter(None, causes), _ACCEPT))


def plan_of(goal: Goal) -> Plan:
    """Return the plan of an accepted goal, from the joints' true positions when it was accepted."""
    begin = require_accepted(goal).accepted_at
    return Plan.of(goal.request.trajectory, joints_at(goal.run, begin).positions, begin)


def joints_at(run: RobotRecord, t: float) -> ev.JointsTruth:
    """Return the joints at a time (s): the last report up to then, or the first of all."""
    return run.reported(ev.JointsTruth, t, t, of="the joints")[-1]


def worst_at(goal: Goal, t: float, wanted: Mapping[str, float]) -> tuple[str, float]:
    """Return the joint that was farthest (rad) from its wanted position at a time (s), and its distance."""
    return largest(errors(joints_at(goal.run, t).positions, wanted))


def joints_between(run: RobotRecord, start: float, end: float) -> Sequence[ev.JointsTruth]:
    """Return the reports from `start` to `end` (s); they must cover the whole time."""
    joints_at(run, start)  # so that the error for a gap there names the time `start`
    return run.reported(ev.JointsTruth, start, end, of="the joints")
