"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario
from autograder.authoring.obligation import check_of

from . import model

FRAMES = ["shoulder", "base_link", "l_shoulder", "", "/shoulder", "Shoulder"]
ROBOTS_ARM = {
    "upper_arm_length": 0.22,
    "forearm_length": 0.30,
}  # m: to the elbow, and on to between the fingers

# It has a robot, which notices a busy machine; on such a machine Python takes seconds to end.
POINTS = Scenario(
    "in_order",
    {
        "steps": [
            ["ask", [x, y, elbow_up]]
            for x, y in ((0.4, 0.3), (0.45, -0.1), (0.1, 0.3), (0.53, 0.12), (-0.2, 0.35), (-0.3, -0.1))
            for elbow_up in (False, True)
        ],
        "interrupt": True,
    },
    robot=RESTING,
)
LIMITS = Scenario(
    "in_order",
    {
        "steps": [
            *(["ask", [0.4, 0.3]], ["ask", [0.5, 0.4]], ["ask", [0.56, 0.0]], ["ask", [-0.3, -0.5]]),
            *(
                ["ask", [0.03, 0.02]],
                ["ask", [0.0, 0.0]],
                ["ask", [0.1, 0.5378]],
                ["ask", [-0.3, 0.463]],
                ["ask", [0.053, 0.0, True]],
            ),
        ]
    },
    robot=None,
)
IN_FRAMES = Scenario(
    "in_order",
    {"steps": [["ask", [0.4, 0.3, False, frame]] for frame in FRAMES]},
    robot=None,
)
REAL_ARM = Scenario(
    "in_order",
    {
        "steps": [
            *(["move_to", 0.4, 0.1], ["move_to", 0.3, -0.25]),
            *(["ask", [0.1, 0.05]], ["ask", [-0.05, 0.12]]),
        ],
        "started_with": ROBOTS_ARM,
    },
    parameters=ROBOTS_ARM,
)


server_appears = standard.server_appears(
    "compute_ik", points=1, on=POINTS, see="02_services#first-file", clauses=[10]
)

reaches_the_point = check_of(
    "reaches_the_point",
    model.reaches_the_point,
    title="The angles it answers with bring the hand to the point, within 1 mm",
    points=2,
    on=POINTS,
    needs=server_appears,
    see="04_your_own_interfaces#cosine-why",
)

bends_the_elbow_as_asked = check_of(
    "bends_the_elbow_as_asked",
    model.bends_the_elbow_as_asked,
    title="The elbow is above the line to the target with elbow_up, below it without",
    points=2,
    on=POINTS,
    needs=reaches_the_point,
    see="04_your_own_interfaces#cosine-why",
)

says_what_is_out_of_reach = check_of(
    "says_what_is_out_of_reach",
    model.refuses_nothing_within_reach,
    model.says_what_is_out_of_reach,
    title="Too far and too near is NO_IK_SOLUTION, and what can be reached is not",
    points=2,
    on=LIMITS,
    needs=server_appears,
    see="04_your_own_interfaces#cosine-why",
)

refuses_other_frames = check_of(
    "refuses_other_frames",
    model.refuses_other_frames,
    points=1,
    on=IN_FRAMES,
    needs=server_appears,
    see="04_your_own_interfaces#server-why",
)

moves_the_real_hand = check_of(
    "moves_the_real_hand",
    model.reaches_the_point,
    model.moves_the_real_hand,
    title="Started with the robot's own lengths as parameters, its angles bring the robot's hand to the point",
    points=2,
    on=REAL_ARM,
    needs=bends_the_elbow_as_asked,
    see="04_your_own_interfaces#parameters-why",
)

ends_cleanly = standard.ends_cleanly(
    points=1, on=POINTS, needs=server_appears, see="02_services#conventions", clauses=[11]
)
