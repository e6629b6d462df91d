"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario
from autograder.authoring.obligation import check_of

from . import model

# A stand holds the robot by its chest, so that it hangs limp without power and stands when it returns.
ON_A_STAND = ("--scene", "stand")
INTERRUPT = Scenario("in_order", {"steps": [["ask", 1]], "interrupt": True}, robot=RESTING)
STATUS = Scenario(
    "in_order",
    {"steps": [["switch_elsewhere", False], ["ask", 3], ["switch_elsewhere", True], ["ask", 1]]},
    robot=ON_A_STAND,
)
SILENT_ROBOT = Scenario(
    "in_order",
    {"steps": [["ask", 3], ["publish_state", True], ["ask", 1]]},
    robot=(*RESTING, "--robot-state-unpublished"),
)
SWITCH = Scenario(
    "in_order",
    {
        "steps": [
            *(
                ["switch", False],
                ["settle"],
                ["switch", False],
                ["switch_elsewhere", True],
                ["switch", False],
            ),
            ["settle"],
            *(["switch", True], ["settle"], ["switch", True, 5], ["settle"]),
        ]
    },
    robot=ON_A_STAND,
)
WALK = Scenario(
    "in_order",
    {
        "steps": [
            *(["walk", [0.3, 0.0, 0.0]], ["switch", False, 3], ["wait", 1.6]),
            *(["knock_over", [0.0, 60.0, 0.0]], ["switch", False], ["settle"]),
        ]
    },
)


server_appears = standard.server_appears(
    "enable_motors and get_status", points=1, on=INTERRUPT, see="02_services#first-file"
)

tells_the_status = check_of(
    "tells_the_status",
    model.tells_the_motors,
    title='get_status says "Motors: ON" while the motors are on',
    points=1,
    on=INTERRUPT,
    needs=server_appears,
    see="02_services#first-file",
)

follows_the_robot = check_of(
    "follows_the_robot",
    model.tells_the_motors,
    model.status_in_time,
    model.status_from_memory,
    title="When somebody else cuts the power and returns it, get_status says so, at once",
    points=2,
    on=STATUS,
    needs=tells_the_status,
    see="02_services#diagram",
)

says_when_it_knows_nothing = check_of(
    "says_when_it_knows_nothing",
    model.status_from_memory,
    model.says_when_it_knows_nothing,
    title="Before the first robot_state, get_status answers success: false, at once",
    points=1,
    on=SILENT_ROBOT,
    needs=server_appears,
    see="02_services#m9-fix-why",
)

powers_off = check_of(
    "powers_off",
    model.grants_power_off,
    title="enable_motors with data: false is granted to a standing or limp robot, and its motors lose their torque",
    points=2,
    on=SWITCH,
    needs=server_appears,
    see="02_services#set-file",
)

powers_on = check_of(
    "powers_on",
    model.grants_power_on,
    model.power_in_time,
    title="enable_motors with data: true is granted, also five at once, and the motors have their torque again",
    points=1,
    on=SWITCH,
    needs=powers_off,
    see="02_services#set-file",
)

refuses_off_while_walking = check_of(
    "refuses_off_while_walking",
    model.refuses_power_off,
    model.commands_only_what_was_granted,
    model.lets_it_walk,
    model.power_never_sleeps,
    model.grants_power_off,
    title="While the robot walks, and only then, power off is refused with a sentence, and it walks on",
    points=3,
    on=WALK,
    needs=powers_off,
    see="02_services#set-refuse-why",
)

ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="02_services#conventions", clauses=[7]
)
