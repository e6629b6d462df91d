"""The rhythm of the steps, how high and how far they go, and when a step begins and ends."""

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
    """Rhythm of the steps and the thresholds between standing, shifting and stepping."""

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

    capture_duration: float = 0.28  # s, a step that catches a push
    capture_double_support: float = 0.02  # s
    capture_forward: float = 0.085  # m, DCM offset in standing that makes it step
    capture_sideways: float = 0.13  # m

    lifted_height: float = 0.015  # m, a sole this high without load is put down by a step

    touchdown_force: float = 15.0  # N
    touchdown_progress: float = 0.6  # of the swing; earlier contact is scuffing
    freeze_landing: float = 0.9  # of the swing; later the landing is not moved

    stand_dcm_forward: float = 0.07  # m, DCM offset at touchdown from which standing is safe
    stand_dcm_sideways: float = 0.10  # m
    stand_feet_offset: float = 0.05  # m, fore-aft distance of the feet
    stand_feet_width: float = 0.06  # m, deviation from feet_width

    goal_tolerance: float = 0.02  # m
    goal_yaw_tolerance: float = 0.05  # rad
    goal_facing_distance: float = 0.7  # m, farther goals are faced while walking
