"""The checks that students can see and run themselves."""

from __future__ import annotations

from autograder.authoring import RESTING, check_of, in_order, standard

from . import model

# Joints at different angles, one of them twice, neither in the robot's order nor sorted.
SOME_JOINTS = ["r_knee", "l_shoulder_roll", "r_shoulder_roll", "r_knee", "l_hip_pitch", "l_elbow"]
SOME_JOINTS += ["r_shoulder_pitch"]
POSTURE = {"r_elbow": -0.9, "l_wrist_yaw": 0.3, "l_shoulder_pitch": -0.5}  # rad
POSTURE |= {"head_pan": 0.7, "r_shoulder_roll": -0.8, "l_elbow": -1.4}  # rad
STRANGERS = ["tail_yaw", "l_knee", "r_wing_pitch", "head_pan", "antenna_2", "l_wheel", "gripper"]
UNPLUGGED_ROBOT = (*RESTING, "--joint-sensors-unplugged")

ASK = in_order(["let_arrive"], ["ask", SOME_JOINTS], ["ask", []], interrupt=True)
# Ctrl-C before the first message
UNHEARD = in_order(["ask", SOME_JOINTS], robot=UNPLUGGED_ROBOT, interrupt=True)
MOVED = in_order(
    *(["let_arrive"], ["ask", [*POSTURE]], ["reverse", True], ["move", POSTURE], ["ask", [*POSTURE]]),
    *(["unplug"], ["wait", 5.5], ["ask", [*POSTURE]]),
)
STRANGE = in_order(
    *(["let_arrive"], ["ask", STRANGERS], ["ask", ["l_knee"]]),
    *(["ask", ["elbow"]], ["ask", ["R_Elbow"]], ["ask", ["head_pan"]]),
)
UNPLUGGED = in_order(
    *(["ask", SOME_JOINTS], ["ask", []], ["ask", ["l_knee"], STRANGERS]),
    *(["plug_in"], ["let_arrive"], ["ask", SOME_JOINTS]),
    robot=UNPLUGGED_ROBOT,
)

KNOWS_NOTHING = "02_services#m9-fix-why"

server_appears = standard.server_appears("get_joint_positions", on=ASK, clauses=[7])

finds_the_joints = check_of(model.finds_the_joints, on=ASK, needs=server_appears)

keeps_the_order_asked = check_of(model.keeps_the_order_asked, on=ASK, needs=finds_the_joints)

positions_are_the_robots = check_of(model.positions_are_the_last, points=2, on=ASK, needs=finds_the_joints)

no_names_means_all = check_of(model.lists_every_joint_once, on=ASK, needs=finds_the_joints)

follows_the_robot = check_of(
    [model.finds_the_joints, model.positions_are_the_last],
    title="It follows the arms' motion, in any order of the joints, and keeps the last positions during a pause",
    on=MOVED,
    needs=positions_are_the_robots,
    see="02_services#diagram",
)

names_every_unknown_joint = check_of(
    [model.refuses_unknown_joints, model.names_every_unknown_joint, model.finds_the_joints],
    title="For unknown joints it responds with success false and a message with each name; then it works as before",
    points=2,
    on=STRANGE,
    needs=finds_the_joints,
)

says_when_it_knows_nothing = check_of(
    [model.never_waits, model.says_when_it_knows_nothing],
    title="Before the first joint_states it responds to any request at once with success false",
    on=UNPLUGGED,
    needs=server_appears,
    see=KNOWS_NOTHING,
)

ends_cleanly = standard.ends_cleanly(on=[ASK, UNHEARD], needs=server_appears, clauses=[8])
