"""The timing of the steps, their height and length, and the conditions on which a step begins and ends."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StepLimits:
    """How far the body may move in one step, in the frame of the stance foot."""

    forward: float = 0.18  # m
    backward: float = 0.10  # m
    outward: float = 0.10  # m, towards the side of the swing foot
    inward: float = 0.02  # m
    turn_outward: float = 0.30  # rad
    turn_inward: float = 0.12  # rad
    reach_forward: float = 0.40  # m, landing of the swing foot from the stance foot
    reach_backward: float = 0.36  # m
    reach_inner: float = 0.115  # m, closer would touch the stance foot
    reach_outer: float = 0.50  # m


@dataclass(frozen=True, slots=True)
class GaitParameters:
    """Timing of the steps and the thresholds between standing, shifting and stepping."""

    duration: float = 0.44  # s, nominal length of a step
    double_support: float = 0.05  # s, at its start
    min_duration: float = 0.22  # s
    max_duration: float = 0.60  # s
    timing_rate: float = 9.0  # s/s, how fast the touchdown time may move
    feet_width: float = 0.18  # m, between the sole centres
    step_height: float = 0.04  # m, of the swing foot at its highest
    planned_steps: int = 3

    shift_gain: float = 1.5
    shift_tolerance: float = 0.02  # m, DCM error at which a foot may be lifted
    shift_min_time: float = 0.10  # s
    shift_max_time: float = 1.00  # s

    capture_duration: float = 0.28  # s, of a step that catches a push
    capture_double_support: float = 0.02  # s
    capture_forward: float = 0.085  # m, DCM offset while standing above which such a step begins
    capture_sideways: float = 0.13  # m

    lifted_height: float = 0.015  # m; a step puts down a foot without load whose sole is higher than this

    touchdown_force: float = 15.0  # N
    touchdown_progress: float = 0.6  # share of the swing; earlier contact does not count as touchdown
    freeze_landing: float = 0.9  # share of the swing; later the landing is not moved

    stand_dcm_forward: float = 0.07  # m, DCM offset at touchdown up to which standing is safe
    stand_dcm_sideways: float = 0.10  # m
    stand_feet_offset: float = 0.05  # m, fore-aft distance of the feet
    stand_feet_width: float = 0.06  # m, deviation from feet_width

    goal_tolerance: float = 0.02  # m
    goal_yaw_tolerance: float = 0.05  # rad
    goal_facing_distance: float = 0.7  # m; the robot turns to a goal that is farther away
