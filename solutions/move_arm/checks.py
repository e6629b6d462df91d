"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from autograder.authoring import RESTING, check_of, standard
from autograder.authoring.walking.server_checks import in_order

from . import model

QUIET_TIME = 1.5  # s after a result, in which no more feedback may be published
STOP_AND_STAY_TIME = 2.5  # s after a cancel or abort, in which an arm must stop and stay still
TWO, THERE, FURTHER = ["l_elbow", "l_wrist_yaw"], [-0.8, 0.1], [-1.0, 0.2]
SHORT = ["l_shoulder_pitch", "l_elbow"]


def far(name: str, arm: str) -> list[Any]:
    """Return the step that sends a goal which bends an elbow slowly and far."""
    return ["go", name, arm, [f"{arm}_elbow", f"{arm}_wrist_pitch"], [[4.0, [-2.1, 0.3]]]]


MOVE = in_order(
    [
        *("go", "move", "l", ["l_elbow", "l_shoulder_pitch", "l_wrist_yaw"]),
        [[1.5, [-0.9, -0.2, 0.2]], [2.8, [-1.2, -0.3, 0.4]], [4.1, [-0.9, -0.2, 0.2]]],
    ],
    ["be_over", "move"],
    ["wait", QUIET_TIME],
)
IMPOSSIBLE = in_order(
    ["go", "no arm", "x", TWO, [[1.0, THERE]]],
    ["go", "unknown joint", "l", ["l_elbow", "l_elbow_2"], [[1.0, THERE]]],
    ["go", "other arm's joint", "l", ["l_elbow", "r_elbow"], [[1.0, [-0.8, -0.8]]]],
    ["go", "leg's joint", "l", ["l_elbow", "l_knee"], [[1.0, [-0.8, 0.8]]]],
    ["go", "no point", "l", TWO, []],
    ["go", "too few positions", "l", TWO, [[1.0, THERE], [2.0, FURTHER[:1]]]],
    ["go", "too many positions", "l", TWO, [[1.0, [*THERE, 0.0]], [2.0, FURTHER]]],
    ["go", "equal times", "l", TWO, [[1.0, THERE], [1.0, FURTHER]]],
    ["go", "falling times", "l", TWO, [[1.0, THERE], [3.0, FURTHER], [2.0, THERE]]],
    ["go", "NaN first", "l", TWO, [[1.0, [math.nan, 0.1]], [2.0, FURTHER]]],
    ["go", "NaN last", "l", TWO, [[1.0, THERE], [2.0, [-1.0, math.nan]]]],
    ["go", "infinite", "l", TWO, [[1.0, [-0.8, -math.inf]]]],
    ["go", "above the range", "l", TWO, [[1.0, [0.2, 0.1]], [2.0, FURTHER]]],
    ["go", "below the range", "l", TWO, [[1.0, THERE], [2.0, [-2.6, 0.2]]]],
    robot=RESTING,
    watched=False,
)
BLOCK = in_order(
    ["go", "move", "l", ["l_shoulder_pitch", "l_elbow", "l_wrist_pitch"], [[4.0, [0.0, -2.1, 0.2]]]],
    *(["get_going", "l_elbow"], ["hold", "l_elbow"], ["end", "move"], ["wait", 0.5]),
    *(["release", "l_elbow"], ["wait", STOP_AND_STAY_TIME]),
)
HOLD_SHORT = in_order(
    ["go", "move", "l", SHORT, [[3.0, [0.0, -1.7]]]],
    *(["hold_short", "move", 0.35, "l_elbow"], ["end", "move"], ["wait", QUIET_TIME]),
)
CANCEL = in_order(
    far("move", "l"),
    ["get_going", "l_elbow"],
    ["cancel", "move"],
    ["end", "move"],
    ["wait", STOP_AND_STAY_TIME],
)
PREEMPT = in_order(
    *(far("old", "l"), ["get_going", "l_elbow"]),
    *(["go", "new", "l", TWO, [[2.5, [-0.2, 0.4]]]], ["end", "old"], ["arrive", "new"]),
)
BOTH = in_order(  # the right arm's goal ends first
    *(far("left", "l"), ["get_going", "l_elbow"]),
    ["go", "right", "r", ["r_elbow", "r_shoulder_pitch"], [[1.5, [-1.0, 0.0]]]],
    *(["arrive", "right"], ["arrive", "left"]),
)
INTERRUPT = in_order(far("move", "l"), ["get_going", "l_elbow"], ["interrupt"])

LOOK, THE_END = "07_cancel_and_preempt#conventions", "07_cancel_and_preempt#m13-why"
TRAJECTORY, BEND = "09_arms#conventions", "09_arms#bend-why"

server_appears = standard.server_appears(
    "the action move_arm", on=INTERRUPT, see="07_cancel_and_preempt#fix-file", clauses=[17]
)
accepts_a_trajectory = check_of(
    model.accepts,
    title="It accepts a trajectory of an arm's joints within their ranges",
    on=MOVE,
    needs=server_appears,
)
of_a_move = partial(check_of, on=MOVE, needs=accepts_a_trajectory)
of_the_impossible = partial(check_of, on=IMPOSSIBLE, needs=accepts_a_trajectory, see=TRAJECTORY)
arrives = of_a_move(model.succeeds, points=2)
after_a_move = partial(check_of, on=MOVE, needs=arrives, see=THE_END)
passes_every_point = of_a_move(model.passes_points)
fills_the_result = after_a_move(model.names_no_error)
feedback_keeps_its_rate = of_a_move(model.feedback_at_10_hz)
feedback_is_true = of_a_move(model.feedback_is_true)
feedback_ends_with_the_goal = after_a_move(model.no_late_feedback)
rejects_foreign_joints = of_the_impossible(
    [model.rejects_arms, model.rejects_joints],
    title="It rejects an arm that is neither l nor r, and joints that are not this arm's",
    see="09_arms#silent-why",
)
rejects_lists_that_do_not_fit = of_the_impossible(
    [model.rejects_no_point, model.rejects_lengths],
    title="It rejects a trajectory without points, and points with too few or too many positions",
)
rejects_times_that_do_not_rise = of_the_impossible(model.rejects_times)
rejects_nan = of_the_impossible(model.rejects_not_finite)
rejects_out_of_range = of_the_impossible(model.rejects_beyond, see="09_arms#silent-why")
of_a_block = partial(check_of, on=BLOCK)
aborts_when_the_arm_is_blocked = of_a_block(model.strays, points=2, needs=arrives)
names_the_blocked_joint = of_a_block(
    model.names_the_joint,
    title="error_msg names the blocked joint, and no other",
    needs=aborts_when_the_arm_is_blocked,
)
holds_when_the_arm_was_blocked = of_a_block(model.holds_when_given_up, needs=aborts_when_the_arm_is_blocked)
short_of_the_end = partial(check_of, on=HOLD_SHORT)
aborts_when_the_end_is_missed = short_of_the_end(model.misses, points=2, needs=arrives)
names_the_worst_joint = short_of_the_end(
    model.names_the_joint,
    title="error_msg names the joint that is farthest from its last position, and no other",
    needs=aborts_when_the_end_is_missed,
)
of_a_cancel = partial(check_of, on=CANCEL)
cancels = of_a_cancel(
    [model.grants_cancels, model.moves_until_canceled],
    title="A cancel while the arm moves is accepted, and the goal ends CANCELED",
    points=2,
    needs=accepts_a_trajectory,
)
stops_when_canceled = of_a_cancel(model.stops_when_canceled, points=2, needs=cancels)
holds_by_an_empty_trajectory = of_a_cancel(model.stops_by_an_empty_trajectory, needs=stops_when_canceled)
new_goal_preempts_the_old = check_of(
    [model.accepts, model.gives_way, model.succeeds],
    title="A new goal for the same arm aborts the old one with PREEMPTED and is carried out",
    points=2,
    on=PREEMPT,
    needs=arrives,
    see="07_cancel_and_preempt#preempt-why",
)
moves_both_arms = check_of(
    [model.accepts, model.succeeds_beside_the_other],
    title="Goals for both arms are carried out at the same time",
    points=2,
    on=BOTH,
    needs=arrives,
    see="09_arms#replace-why",
)
ends_cleanly = standard.ends_cleanly(on=INTERRUPT, needs=server_appears, see=LOOK, clauses=[17])
