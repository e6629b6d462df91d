"""Where the arms' joints were, as the simulator has it; the scenario has asked for it with `report_joints`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.authoring import Goal, RobotRecord, ev, why_no_message_arrives

from .plan import Plan, errors, largest

_ACCEPT = (
    "goal_callback must return GoalResponse.ACCEPT for a trajectory in which nothing is wrong (True is not "
    "GoalResponse.ACCEPT). Does it know the ranges? joint_limits is published once, so subscribe with "
    "DurabilityPolicy.TRANSIENT_LOCAL."
)


def require_accepted(goal: Goal) -> Goal:
    """Require that the server accepted the goal."""
    deaf = (why_no_message_arrives(goal.run, topic) for topic in ("joint_limits", "joint_states"))
    return goal.require_accepted(next(filter(None, deaf), _ACCEPT))


def plan_of(goal: Goal) -> Plan:
    """Return the plan of an accepted goal, from where the joints really were when it was accepted."""
    begin = require_accepted(goal).accepted_at
    return Plan.of(goal.request.trajectory, joints_at(goal.run, begin).positions, begin)


def joints_at(run: RobotRecord, t: float) -> ev.JointsTruth:
    """Return the joints at a time (s): the last report not later, or the first there is."""
    return run.reported(ev.JointsTruth, t, t, of="the joints")[-1]


def worst_at(goal: Goal, t: float, wanted: Mapping[str, float]) -> tuple[str, float]:
    """Return the joint that was farthest from where it was wanted (rad) at a time (s), and how far."""
    return largest(errors(joints_at(goal.run, t).positions, wanted))


def joints_between(run: RobotRecord, start: float, end: float) -> Sequence[ev.JointsTruth]:
    """Return the reports from `start` to `end` (s); there must be some from end to end."""
    joints_at(run, start)  # so that a gap there is named by its own time
    return run.reported(ev.JointsTruth, start, end, of="the joints")
