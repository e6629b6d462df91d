"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from functools import partial
from random import Random
from typing import Any

from autograder.authoring import NOT_FINITE, Scenario, check_of, rounded
from autograder.authoring.walking.server_checks import in_order
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import QUIET_TIME
from .objections import RANGES

RIGHT = ["r_wrist_pitch", "r_elbow", "r_shoulder_roll"]
REST_TIME = 0.5  # s


def _steps(random: Random) -> dict[str, Any]:
    """Cancel at once, cancel while the other arm moves, block joints, reverse joint_states, send invalid goals.

    At the end joint_states stop. No trajectory is faster than 0.8 rad/s.
    """
    at = random.uniform
    early = random.choice("lr")
    first, last = ([at(-0.6, 0.6), at(*elbow), at(-0.7, -0.5)] for elbow in ((-1.4, -1.1), (-1.0, -0.7)))
    between = [before + 0.3 * (after - before) for before, after in zip(first, last, strict=True)]
    elbow, wrist = last[1] - at(1.1, 1.2), random.choice((-1, 1)) * at(0.45, 0.5)
    steps: list[Any] = [
        *(
            checks.far("early", early),
            ["cancel", "early"],
            ["end", "early"],
            ["wait", checks.STOP_AND_STAY_TIME],
        ),
        # two points within the same second, so that a server that ignores nanosec confuses them
        ["go", "whole", "r", RIGHT, [[2.0, first], [2.8, between], [4.4, last]]],
        ["wait", at(1.2, 1.6)],
        ["go", "beside", "l", ["l_elbow", "l_wrist_yaw"], [[2.5, [at(-1.7, -1.5), at(-0.5, 0.5)]]]],
        *(["get_going", "l_elbow"], ["cancel", "beside"], ["end", "beside"]),
        *(["be_over", "whole"], ["wait", QUIET_TIME]),
        ["go", "near enough", "l", checks.SHORT, [[2.5, [0.0, at(-2.1, -1.9)]]], 0.45],
        *(["hold_short", "near enough", 0.35, "l_elbow"], ["arrive", "near enough"]),
        *(["release", "l_elbow"], ["wait", REST_TIME]),
        *(["go", "blocked upwards", "l", ["l_elbow"], [[3.0, [-0.3]]]], ["get_going", "l_elbow"]),
        *(["hold", "l_elbow"], ["end", "blocked upwards"], ["release", "l_elbow"], ["wait", REST_TIME]),
        ["go", "in time", "l", checks.SHORT, [[2.5, [0.0, at(-0.9, -0.7)]]]],
        *(["hold_short", "in time", 0.35, "l_elbow"], ["release_late", "in time", 0.4, "l_elbow"]),
        *(["arrive", "in time"], ["wait", QUIET_TIME]),
        ["go", "too late", "r", ["r_wrist_yaw", "r_elbow"], [[3.0, [wrist, elbow]]]],
        *(["hold_short", "too late", 0.35, "r_wrist_yaw", "r_elbow"], ["end", "too late"]),
        *(["release", "r_wrist_yaw", "r_elbow"], ["wait", QUIET_TIME], ["reverse_joint_states"]),
        [
            "go_together",
            ["left", "l", ["l_wrist_pitch", "l_elbow"], [[2.5, [at(-0.5, 0.5), at(-2.0, -1.8)]]]],
            ["right", "r", ["r_wrist_pitch", "r_elbow"], [[2.5, [at(-0.5, 0.5), at(-1.2, -1.0)]]]],
        ],
        *(["get_going", "l_elbow"], ["go", "newer", "l", ["l_elbow"], [[2.0, [at(-0.6, -0.4)]]]]),
        *(["end", "left"], ["be_over", "right"], ["be_over", "newer"], ["wait", REST_TIME]),
        *_impossible(random),  # near the end, so that one that is accepted does not disturb other goals
        ["go", "lost", "l", ["l_elbow"], [[6.0, [-1.7]]]],
        *(["get_going", "l_elbow"], ["unplug_joint_states"], ["end", "lost"], ["wait", QUIET_TIME]),
    ]
    return {"steps": rounded(steps)}


def _impossible(random: Random) -> list[list[Any]]:
    """Return steps that send goals for the right arm, each with one invalid position, name, time or length."""
    low, high = RANGES["r_shoulder_roll"]  # the mirror image of the left arm's range
    below, above = low - random.uniform(0.05, 0.1), high + random.uniform(0.05, 0.1)
    sent: list[list[Any]] = []
    for number, position in enumerate((below, above, random.choice(NOT_FINITE)), start=1):
        points: list[list[Any]] = [[t, [random.uniform(-0.6, -0.3)]] for t in (1.0, 2.0, 3.0)]
        points[random.randrange(3)][1] = [position]
        sent.append(["go", f"impossible {number}", "r", ["r_shoulder_roll"], points])
    there = [[1.0, [-0.5]]]
    sent += [
        ["go", "no such arm", random.choice(("", "left", "R", "lr")), ["r_elbow"], there],
        ["go", "foreign", "r", [random.choice(("l_elbow", "r_hip_yaw", "r_finger_1", "elbow", ""))], there],
        ["go", "back in time", "r", ["r_elbow"], [[1.6, [-0.5]], [random.choice((1.1, 1.6)), [-0.6]]]],
        ["go", "too many", "r", ["r_elbow"], [*there, [1.5, [-0.6, *[0.0] * random.randint(1, 2)]]]],
        ["go", "nowhere", "r", ["r_elbow"], []],
    ]
    random.shuffle(sent)
    return sent


ANY_ORDER = Scenario("in_order", _steps)
OTHER_NAMESPACE = in_order(
    ["go", "move", "l", ["l_elbow"], [[1.5, [-1.0]]]], ["arrive", "move"], namespace="/lab_7/robot"
)

in_any_order = partial(check_of, on=ANY_ORDER)
moves_the_right_arm = in_any_order(
    [
        model.accepts,
        model.passes_points,
        model.succeeds,
        model.names_no_error,
        model.misses,
        model.strays,
        model.names_the_joint,
        model.holds_when_given_up,
        model.feedback_at_10_hz,
        model.feedback_is_true,
        model.no_late_feedback,
        model.grants_cancels,
        model.answers_cancels,
        model.stops_by_an_empty_trajectory,
        model.keeps_order,
        model.gives_way,
        model.stays_without_a_goal,
    ],
    title="It moves both arms through random points in any situation, and fulfils every clause",
    points=2,
    needs=[checks.arrives, checks.passes_every_point],
    see="09_arms#clock-why",
)
reads_joint_states_by_name = in_any_order(
    model.succeeds_by_name, needs=checks.arrives, see="02_services#first-file"
)
knows_each_joints_range = in_any_order(
    [
        model.accepts,
        model.rejects_beyond,
        model.rejects_not_finite,
        model.rejects_arms,
        model.rejects_joints,
        model.rejects_no_point,
        model.rejects_lengths,
        model.rejects_times,
    ],
    title="It rejects positions slightly outside each joint's range, in any point, and all invalid trajectories",
    points=2,
    needs=checks.rejects_out_of_range,
    see="09_arms#silent-why",
)
feedback_shows_a_blocked_arm = check_of(
    model.feedback_is_true,
    title="max_error grows while the arm is blocked",
    on=checks.BLOCK,
    needs=[checks.aborts_when_the_arm_is_blocked, checks.feedback_is_true],
)
short_of_the_end = partial(
    check_of, on=ANY_ORDER, needs=checks.aborts_when_the_end_is_missed, see=checks.BEND
)
obeys_goal_tolerance = short_of_the_end(model.succeeds_by_its_tolerance)
waits_a_second_for_the_end = short_of_the_end(model.succeeds_late)
cancels_at_the_start = in_any_order(
    [model.grants_cancels, model.stops_when_canceled],
    title="A cancel right after acceptance ends CANCELED, with the arm still",
    needs=checks.stops_when_canceled,
)
moves_again_after_a_cancel = in_any_order(
    model.succeeds_after_a_cancel,
    needs=[checks.stops_when_canceled, checks.arrives],
    see="07_cancel_and_preempt#fix-intro",
)
a_cancel_spares_the_other_arm = in_any_order(
    [model.succeeds_beside_the_other, model.stops_when_canceled],
    title="When one arm's goal is cancelled, that arm stops and the other goes on moving",
    points=2,
    needs=[checks.stops_when_canceled, checks.moves_both_arms],
    see="09_arms#replace-why",
)
aborts_without_joint_states = in_any_order(
    [model.notices_silence, model.holds_when_given_up],
    title="When no joint_states come for 1 s, the goal ends with INVALID_JOINTS and the arm stops",
    needs=checks.arrives,
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "moves the arm of the robot", model.succeeds, clauses=[17], on=OTHER_NAMESPACE, needs=checks.arrives
)
