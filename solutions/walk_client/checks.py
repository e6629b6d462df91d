"""The checks that students can see and run themselves."""

from __future__ import annotations

from autograder.authoring import check_of
from autograder.authoring.walking import every_client
from autograder.authoring.walking.client_obligations import follows
from autograder.authoring.walking.client_scenarios import GOOD, ON_AND_ON, WRONG_ARGUMENTS, typed, walk

from . import model

WRONG = [walk({}, arguments=arguments) for arguments in WRONG_ARGUMENTS]
REJECTING = walk({"accepted": False})
NEVER_CANCELED = walk({**ON_AND_ON, "cancel": {"ends_after": None}}, *typed(), ["press_ctrl_c"])

sends_the_goal = check_of(model.sends_one_goal, points=2, on=GOOD)

prints_the_feedback = check_of(model.prints_each_feedback, points=2, on=GOOD, needs=sends_the_goal)

says_how_it_succeeded = check_of(
    follows(3, 4),
    title="After SUCCEEDED it prints that with the final pose, and exits with status 0",
    points=2,
    on=GOOD,
    needs=sends_the_goal,
    see="06_walk_to_a_pose#follow-task",
)

refuses_wrong_arguments = check_of(model.refuses_what_is_no_pose, on=WRONG, needs=says_how_it_succeeded)

gives_up_without_a_server = every_client.check("gives_up_without_a_server", 6, 9)

tells_a_rejection = check_of(
    follows(5, 9),
    title="After a rejected goal it exits with status 2",
    on=REJECTING,
    needs=says_how_it_succeeded,
    see="06_walk_to_a_pose#client-intro",
)

tells_an_abort = every_client.check("tells_an_abort", 3, 9, points=2, needs=says_how_it_succeeded)

gives_up_in_silence = every_client.check("gives_up_in_silence", 7, 9, points=2, needs=says_how_it_succeeded)

ctrl_c_cancels_the_goal = every_client.check(
    "ctrl_c_cancels_the_goal", 10, points=2, needs=says_how_it_succeeded, also_on=[NEVER_CANCELED]
)
