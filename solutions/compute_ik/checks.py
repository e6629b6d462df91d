"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from functools import partial

from autograder.authoring import check_of, in_order, standard

from . import model

FRAMES = ["shoulder", "base_link", "l_shoulder", "", "/shoulder", "Shoulder"]
ROBOTS_ARM = {
    "upper_arm_length": 0.22,
    "forearm_length": 0.30,
}  # m: shoulder to elbow, elbow to between the fingers
OTHER_ARM = [["upper_arm_length", 0.35], ["forearm_length", 0.2]]  # m
REACHED = [[0.4, 0.3], [0.45, -0.1], [0.1, 0.3], [0.53, 0.12], [-0.2, 0.35], [-0.3, -0.1]]
NEAR_THE_LIMITS = [[0.4, 0.3], [0.1, 0.5378], [-0.3, 0.463], [0.053, 0.0, True]]
BEYOND = [[0.5, 0.4], [0.56, 0.0], [-0.3, -0.5], [0.03, 0.02], [0.0, 0.0], [0.4, math.nan]]
OF_ROBOTS_ARM = [[0.1, 0.05], [-0.05, 0.12]]
OF_OTHER_ARM = [[0.5, 0.1], [0.2, -0.1, True], [0.3, -0.2]]

# This scenario starts a robot because the robot detects an overloaded machine, where Python takes seconds to exit.
ANSWERS = [["ask", [*point, elbow_up]] for point in REACHED for elbow_up in (False, True)]
POINTS = in_order(*ANSWERS, interrupt=True)
LIMITS = in_order(*(["ask", point] for point in NEAR_THE_LIMITS + BEYOND), robot=None)
IN_FRAMES = in_order(*(["ask", [0.4, 0.3, False, frame]] for frame in FRAMES), robot=None)
REAL_ARM = in_order(
    *(["move_to", 0.4, 0.1], ["move_to", 0.3, -0.25]),
    *(["ask", point] for point in OF_ROBOTS_ARM),
    ["set_together", *OTHER_ARM],
    *(["ask", point] for point in OF_OTHER_ARM),
    robot=(),
    started_with=ROBOTS_ARM,
    parameters=ROBOTS_ARM,
)

server_appears = standard.server_appears("compute_ik", on=POINTS, clauses=[10])

once_it_appears = partial(check_of, needs=server_appears)

reaches_the_point = once_it_appears(
    [model.reaches_the_point, model.answers_in_time, model.never_waits],
    title="The response comes at once, and its angles bring the hand to the point within 1 mm",
    points=2,
    on=POINTS,
)

bends_the_elbow_as_asked = check_of(
    model.bends_the_elbow_as_asked, points=2, on=POINTS, needs=reaches_the_point
)

says_what_is_out_of_reach = once_it_appears(
    [
        model.refuses_nothing_within_reach,
        model.says_what_is_out_of_reach,
        model.refuses_a_pose_that_is_not_finite,
    ],
    title="A target too far or too near gets NO_IK_SOLUTION, one within reach SUCCESS, and NaN never SUCCESS",
    points=2,
    on=LIMITS,
)

refuses_other_frames = once_it_appears(model.refuses_other_frames, on=IN_FRAMES)

moves_the_real_hand = check_of(
    [model.reaches_the_point, model.moves_the_real_hand, model.uses_the_lengths_it_accepted],
    title="With the robot's own lengths as parameters, the angles bring the robot's hand to the point; "
    "lengths set later are used or rejected",
    points=2,
    on=REAL_ARM,
    needs=bends_the_elbow_as_asked,
    see="04_your_own_interfaces#parameters-why",
)

ends_cleanly = standard.ends_cleanly(on=POINTS, needs=server_appears, clauses=[11])
