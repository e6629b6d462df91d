"""The checks that students can see and run themselves."""

from __future__ import annotations

from autograder.authoring import RESTING, check_of, in_order, standard

from . import model

# A stand holds the robot by its chest: without power it hangs limp, and with power it stands again.
ON_A_STAND = ("--scene", "stand")
UNPUBLISHED_ROBOT = (*RESTING, "--robot-state-unpublished")
INTERRUPT = in_order(["ask", 1], interrupt=True)
# Ctrl-C before the first robot_state
UNHEARD = in_order(["ask", 1], robot=UNPUBLISHED_ROBOT, interrupt=True)
STATUS = in_order(
    *(["switch_elsewhere", False], ["ask", 3], ["switch_elsewhere", True], ["ask", 1]),
    *(["publish_state", False], ["switch", False], ["settle"], ["ask", 1]),
    robot=ON_A_STAND,
)
SILENT_ROBOT = in_order(
    *(["ask", 3], ["switch", True], ["publish_state", True], ["ask", 1]), robot=UNPUBLISHED_ROBOT
)
SWITCH = in_order(
    *(["switch", False], ["settle"], ["switch", False], ["switch_elsewhere", True], ["switch", False]),
    *(["settle"], ["switch", True], ["settle"], ["switch", True, 5], ["settle"]),
    robot=ON_A_STAND,
)
WALK = in_order(
    *(["walk", [0.3, 0.0, 0.0]], ["switch", False, 3], ["wait", 1.6]),
    *(["knock_over", [0.0, 60.0, 0.0]], ["switch", False], ["settle"]),
    robot=(),
)

REFUSES, KNOWS_NOTHING = "02_services#set-refuse-why", "02_services#m9-fix-why"

server_appears = standard.server_appears("enable_motors and get_status", on=INTERRUPT)

tells_the_status = check_of(
    model.tells_the_motors,
    title='get_status responds "Motors: ON" while the motors are on',
    on=INTERRUPT,
    needs=server_appears,
)

follows_the_robot = check_of(
    [model.tells_the_motors, model.status_in_time, model.status_from_memory],
    title="When another node switches the power, get_status reports it at once, whatever your node commanded",
    points=2,
    on=STATUS,
    needs=tells_the_status,
    see="02_services#diagram",
)

says_when_it_knows_nothing = check_of(
    [model.status_from_memory, model.says_when_it_knows_nothing],
    title="Before the first robot_state, get_status responds at once with success false",
    on=SILENT_ROBOT,
    needs=server_appears,
    see=KNOWS_NOTHING,
)

powers_off = check_of(model.grants_power_off, points=2, on=SWITCH, needs=server_appears)

powers_on = check_of(
    [model.grants_power_on, model.power_in_time],
    title="enable_motors with data true is accepted and switches the motors on, also before the first robot_state and "
    "for five requests at once; each request is answered in time",
    on=[SWITCH, SILENT_ROBOT],
    needs=powers_off,
)

refuses_off_while_walking = check_of(
    [
        model.refuses_power_off,
        model.commands_only_what_was_granted,
        model.lets_it_walk,
        model.power_never_sleeps,
        model.grants_power_off,
    ],
    title="While the robot walks, and only then, power off is rejected with a sentence, and the robot walks on",
    points=3,
    on=WALK,
    needs=powers_off,
)

ends_cleanly = standard.ends_cleanly(on=[INTERRUPT, UNHEARD], needs=server_appears, clauses=[7])
