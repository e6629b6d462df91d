"""The checks that students can see and run themselves."""

from __future__ import annotations

from autograder.authoring import RESTING, check_of, in_order, standard

from . import model

UNPLUGGED_ROBOT = (*RESTING, "--battery-sensor-unplugged")
ASK_ONCE = in_order(["let_publish", 2], ["ask", 1], interrupt=True)
UNPLUGGED = in_order(["ask", 8], ["plug_in"], ["let_publish", 1], ["ask", 1], robot=UNPLUGGED_ROBOT)
LEVELS = in_order(
    *(["set_battery", 0.8], ["let_publish", 1], ["ask", 1]),
    *(["set_battery", 0.35], ["let_publish", 1], ["ask", 1]),
)
INTERRUPT = in_order(robot=UNPLUGGED_ROBOT, interrupt=True)

KNOWS_NOTHING = "02_services#battery-break-why"

server_appears = standard.server_appears("get_battery_status", on=INTERRUPT, clauses=[5])

answers_with_the_last_message = check_of(
    model.repeats_the_last_message,
    title="The response has the robot's last battery_state in every field",
    on=ASK_ONCE,
    needs=server_appears,
)

says_when_it_knows_nothing = check_of(
    [model.answers_in_time, model.never_waits, model.says_when_it_knows_nothing],
    title="Before the first message it responds at once, with available false and every number NaN",
    points=2,
    on=UNPLUGGED,
    needs=server_appears,
    see=KNOWS_NOTHING,
)

follows_the_battery = check_of(
    model.repeats_the_last_message,
    title="When the charge changes, the response changes, too",
    on=LEVELS,
    needs=answers_with_the_last_message,
)

ends_cleanly = standard.ends_cleanly(on=[INTERRUPT, ASK_ONCE], needs=server_appears, clauses=[6])
