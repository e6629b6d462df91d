"""What students can see being checked."""

from __future__ import annotations

import math

from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check
from autograder.authoring.feedback import require_good_feedback_rate
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.reports import require_error_code

from .endings import (
    require_aborted_by_a_fall,
    require_given_up,
    require_held,
    require_hopeless,
    require_no_rise_afterwards,
    require_rejected_while_busy,
    require_standing_told,
    require_stayed,
)
from .leaning import require_shifted_again, require_waited
from .played import require_bobbing, require_calm, require_rejected_until_known
from .reports import require_measured_percent, require_named_phases, require_percent_never_falls
from .rising import (
    require_accepted,
    require_begun,
    require_crouch,
    require_on_the_spot,
    require_risen,
    require_settled,
)

CROUCH = ("--crouch",)
RISE = Scenario("rise", robot=CROUCH)
UNKNOWN = Scenario("ask_before_anything_is_known", robot=None)
LEANED_ON = Scenario("lean_on_before", {"force": [0.0, 20.0, 0.0], "duration": 4.0}, robot=CROUCH)
PUSHED = Scenario("lean_on_under_way", {"force": [0.0, -20.0, 0.0], "duration": 2.5}, robot=CROUCH)
AHEAD, LEFT, BACK, RIGHT = 0.0, math.pi / 2, math.pi, -math.pi / 2  # rad, in base_link
GLIDES = Scenario(
    "be_restless",
    {"speed": 0.06, "tilt": 0.0, "towards": [AHEAD, RIGHT], "calm": 0.0, "duration": 1.6},
    robot=None,
)
LEANS = Scenario(
    "be_restless",
    {"speed": 0.0, "tilt": 0.12, "towards": [AHEAD, LEFT, BACK, RIGHT], "calm": 0.0, "duration": 1.2},
    robot=None,
)
STANDING = Scenario("ask_a_standing_robot", robot=RESTING)
CANCEL = Scenario("cancel", {"height": 0.48}, robot=CROUCH)
TWICE = Scenario("ask_twice", robot=CROUCH)
HELD = Scenario("hold", robot=CROUCH)
FALL = Scenario("fall", {"impulse": [0.0, 80.0, 0.0]}, robot=CROUCH)
FALLEN = Scenario("ask_a_fallen_robot", {"impulse": [0.0, 80.0, 0.0]})
INTERRUPT = Scenario("interrupt", robot=RESTING)

LOOK = "07_cancel_and_preempt#conventions"

server_appears = standard.server_appears(
    "the action stand_up", on=INTERRUPT, see="06_walk_to_a_pose#small-intro", clauses=[18]
)


@check(on=RISE, needs=server_appears, see="06_walk_to_a_pose#reject-task", clauses=[1])
def accepts_a_goal(run: Transcript) -> None:
    """It accepts a goal while the robot crouches"""
    require_accepted(run.goal("rise"))
    require_crouch(run.goal("rise"))


@check(points=2, on=RISE, needs=accepts_a_goal, see="09_arms#rise-why", clauses=[5, 6, 17])
def rises(run: Transcript) -> None:
    """It SUCCEEDS, and base_link is then at 0.59 m or higher"""
    require_risen(run.goal("rise"))


@check(on=RISE, needs=rises, see="01_robot_and_graph#walk-intro", clauses=[3])
def rises_on_the_spot(run: Transcript) -> None:
    """The robot rises without a step"""
    require_on_the_spot(run.goal("rise"))


@check(points=2, on=RISE, needs=rises, see="09_arms#still-why", clauses=[6])
def settles_before_it_succeeds(run: Transcript) -> None:
    """When it SUCCEEDS the robot has been high, still and upright for 0.5 s"""
    require_settled(run.goal("rise"))


@check(on=GLIDES, needs=rises, see="09_arms#still-why", clauses=[6])
def waits_until_it_is_still(run: Transcript) -> None:
    """It does not succeed while the pelvis moves faster than 0.02 m/s"""
    require_calm(run, run.goal("rise"))


@check(on=LEANS, needs=rises, see="09_arms#still-why", clauses=[6])
def waits_until_it_is_upright(run: Transcript) -> None:
    """It does not succeed while the pelvis leans by more than 0.05 rad"""
    require_calm(run, run.goal("rise"))


@check(on=RISE, needs=accepts_a_goal, see="06_walk_to_a_pose#settle-intro", clauses=[8])
def feedback_keeps_its_rate(run: Transcript) -> None:
    """Feedback comes at 5 Hz without a gap over 1 s"""
    require_good_feedback_rate(run.goal("rise"))


@check(on=RISE, needs=rises, see="09_arms#phases-why", clauses=[9])
def names_its_phases(run: Transcript) -> None:
    """Phase is shifting, rising, settling, each while the robot does it"""
    require_named_phases(run.goal("rise"))


@check(on=RISE, needs=rises, see="08_navigation#zero-why", clauses=[10])
def percent_is_measured(run: Transcript) -> None:
    """percent_complete is the share of the height gained, and ends at 100"""
    require_measured_percent(run.goal("rise"))


@check(
    on=GLIDES,
    needs=accepts_a_goal,
    see="08_navigation#zero-why",
    clauses=[11],
)
def percent_never_falls(run: Transcript) -> None:
    """percent_complete does not fall when the pelvis bobs"""
    require_bobbing(run)
    require_percent_never_falls(run.goal("rise"))


feedback_ends_with_the_goal = standard.feedback_ends_with_the_goal("rise", on=RISE, needs=rises, clauses=[8])


@check(on=UNKNOWN, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task", clauses=[1])
def rejects_before_anything_is_known(run: Transcript) -> None:
    """It rejects a goal before the first messages of the robot, and accepts one after them"""
    require_rejected_until_known(run, run.goal("before"), run.goal("after"))


@check(points=2, on=LEANED_ON, needs=rises, see="09_arms#still-why", clauses=[4, 9])
def waits_for_even_loads(run: Transcript) -> None:
    """While somebody leans on the robot it stays down, in shifting; then it rises"""
    require_waited(run.goal("rise"))
    require_risen(run.goal("rise"))


@check(points=2, on=PUSHED, needs=rises, see="09_arms#phases-why", clauses=[7, 9])
def shifts_again_after_a_push(run: Transcript) -> None:
    """Leaned on while it rises, it stops and goes back to shifting; then it rises"""
    require_shifted_again(run.goal("rise"))
    require_risen(run.goal("rise"))


@check(on=STANDING, needs=server_appears, see="09_arms#phases-why", clauses=[1, 2])
def accepts_a_goal_when_it_stands(run: Transcript) -> None:
    """It accepts a goal for a robot that stands already, because a rejection carries no reason"""
    require_accepted(
        run.goal("standing"),
        help="A rejection carries no reason, so the client would never learn why: accept the goal, and abort it with "
        "ALREADY_STANDING.",
    )


@check(points=2, on=STANDING, needs=accepts_a_goal_when_it_stands, see="09_arms#phases-why", clauses=[2, 17])
def says_that_it_stands_already(run: Transcript) -> None:
    """That goal is ABORTED at once with ALREADY_STANDING and a sentence"""
    require_standing_told(run.goal("standing"))


@check(points=2, on=CANCEL, needs=accepts_a_goal, see="07_cancel_and_preempt#m1-why", clauses=[12])
def cancels_under_way(run: Transcript) -> None:
    """A cancel while the robot rises is agreed to and ends CANCELED"""
    goal = run.goal("canceled")
    request = goal.require_canceled()
    require_error_code(goal, "NONE", because="the goal was canceled, which is no error")
    require_begun(run.goal("canceled"), request.t)


@check(points=2, on=CANCEL, needs=cancels_under_way, see="07_cancel_and_preempt#m12-robot-why", clauses=[12])
def stays_where_it_was_canceled(run: Transcript) -> None:
    """After the cancel the pelvis stays at the height it had reached"""
    require_stayed(run.goal("canceled"))


@check(on=TWICE, needs=rises, see=LOOK, clauses=[13])
def rejects_a_second_goal(run: Transcript) -> None:
    """It rejects a goal while another runs, and the first goes on"""
    require_rejected_while_busy(run.goal("first"), run.goal("second"))


@check(points=2, on=HELD, needs=accepts_a_goal, see="08_navigation#late-why", clauses=[14, 17])
def gives_up_in_time(run: Transcript) -> None:
    """Held down, it ends ABORTED after 12 s, with a sentence"""
    goal = run.goal("held")
    require_held(goal)
    require_given_up(goal, goal.accepted_at)


@check(on=HELD, needs=gives_up_in_time, see="08_navigation#late-why", clauses=[14])
def stays_down_after_the_limit(run: Transcript) -> None:
    """After that the robot stays down, also when it is let go"""
    require_no_rise_afterwards(run.goal("held"))


@check(on=FALL, needs=accepts_a_goal, see="07_cancel_and_preempt#fall-why", clauses=[15, 17])
def aborts_when_the_robot_falls(run: Transcript) -> None:
    """When the robot falls the goal is ABORTED with FELL and a sentence"""
    require_aborted_by_a_fall(run.goal("rise"))


@check(on=FALLEN, needs=server_appears, see="07_cancel_and_preempt#fall-why", clauses=[16])
def knows_that_a_fall_is_the_end(run: Transcript) -> None:
    """A goal for a robot that has fallen is rejected, or ABORTED at once with FELL"""
    require_hopeless(run.goal("fallen"))


ends_cleanly = standard.ends_cleanly(on=INTERRUPT, needs=server_appears, see=LOOK, clauses=[18])
