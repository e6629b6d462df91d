"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.feedback import require_good_feedback_rate
from autograder.authoring.transcript import Transcript

from .endings import require_aborted
from .holding import require_force_kept, require_lifted
from .placing import OPENED, require_filled_result, require_placed, require_withdrawn
from .reports import (
    require_rising_percentage,
    require_stages_in_order,
    require_true_stages,
    require_true_values,
)
from .safe_ends import (
    require_aborted_by_a_fall,
    require_dropped,
    require_grasp_failed,
    require_left_alone,
    require_nothing_moved,
    require_preempted_or_rejected,
    require_put_away,
)
from .truth import taken_from

TABLE = ("--scene", "table")

FETCH = Scenario("fetch", {"place": [0.35, -0.27], "force": 10.0}, robot=TABLE)
IMPOSSIBLE = Scenario("ask_for_the_impossible", robot=RESTING)
UNKNOWN = Scenario("ask_for_the_unknown", {"objects": ["teapot"]}, robot=RESTING)
FAR_PLACE = Scenario("ask_for_the_far", {"place": [0.75, -0.25]}, robot=TABLE)
FAR_CUP = Scenario("ask_for_the_far", {"place": [0.34, -0.20], "cup": [0.57, 0.37]}, robot=TABLE)
TAKEN = Scenario("take_away", robot=TABLE)
SNATCHED = Scenario("snatch", {"way": 0.0}, robot=TABLE)
CANCEL = Scenario("cancel_before_the_grasp", {"closing": False}, robot=TABLE)
HOLDING = Scenario(
    "cancel_while_holding", {"cup": [0.32, -0.10], "place": [0.34, -0.28], "way": 0.0}, robot=TABLE
)
TWO = Scenario("ask_for_two", robot=TABLE)
BLOCKED = Scenario("block", robot=TABLE)
FALL = Scenario("fall", {"impulse": [0.0, 60.0, 0.0]}, robot=TABLE)
INTERRUPT = Scenario("interrupt", robot=RESTING)

LOOK = "07_cancel_and_preempt#conventions"
EARLY, LATE = 0.8, 4.0  # s without a pose after which an object may be, and must be, unknown
PATIENCE = 20.0  # s for a hand that does not arrive

server_appears = standard.server_appears(
    "the action pick_and_place", on=INTERRUPT, see="07_cancel_and_preempt#fix-file", clauses=[21]
)


@check(on=FETCH, needs=server_appears, see="07_cancel_and_preempt#m2-why", clauses=[1])
def accepts_a_goal(run: Transcript) -> None:
    """It accepts a goal with a place in frame odom and a force of 10 N"""
    run.goal("fetch").require_accepted()


@check(points=3, on=FETCH, needs=accepts_a_goal, see="09_arms#careful-why", clauses=[2, 3, 4])
def places_the_cup(run: Transcript) -> None:
    """It SUCCEEDS, and the cup then stands within 0.03 m of place_pose, upright, at rest, with the hand off it"""
    require_placed(run.goal("fetch"))


@check(on=FETCH, needs=places_the_cup, see="09_arms#firm-why", clauses=[4])
def lifts_the_cup(run: Transcript) -> None:
    """It lifts the cup on its way, by 5 cm at least"""
    require_lifted(run.goal("fetch"))


@check(points=2, on=FETCH, needs=lifts_the_cup, see="09_arms#force-why", clauses=[5])
def keeps_the_force(run: Transcript) -> None:
    """While the cup is off the table the measured force is grasp_force, within 30 %"""
    require_force_kept(run.goal("fetch"))


@check(on=FETCH, needs=places_the_cup, see="06_walk_to_a_pose#late-why", clauses=[10])
def fills_the_result(run: Transcript) -> None:
    """The result tells where the cup is, and the largest force that was measured"""
    require_filled_result(run.goal("fetch"))


@check(on=FETCH, needs=accepts_a_goal, see=LOOK, clauses=[7])
def feedback_keeps_its_rate(run: Transcript) -> None:
    """Feedback comes at 5 Hz without a gap over 1 s"""
    require_good_feedback_rate(run.goal("fetch"))


@check(
    on=FETCH,
    needs=places_the_cup,
    see="09_arms#phases-intro",
    clauses=[6],
)
def names_its_stages(run: Transcript) -> None:
    """The stage goes through approaching, grasping, lifting, moving, placing, retreating"""
    require_stages_in_order(run.goal("fetch"))


@check(on=FETCH, needs=[names_its_stages, lifts_the_cup], see="09_arms#phases-why", clauses=[6])
def stages_are_true(run: Transcript) -> None:
    """Each stage is named while it lasts"""
    require_true_stages(run.goal("fetch"))


@check(on=FETCH, needs=accepts_a_goal, see="09_arms#force-why", clauses=[8])
def feedback_is_measured(run: Transcript) -> None:
    """hand_pose, distance_to_object and grasp_force in the feedback are measured"""
    require_true_values(run.goal("fetch"))


@check(on=FETCH, needs=places_the_cup, see="08_navigation#zero-fix-why", clauses=[9])
def percentage_rises(run: Transcript) -> None:
    """percent_complete rises from 0 towards 100 and never falls"""
    require_rising_percentage(run.goal("fetch"))


feedback_ends_with_the_goal = standard.feedback_ends_with_the_goal(
    "fetch", on=FETCH, needs=places_the_cup, clauses=[7]
)


@check(on=IMPOSSIBLE, needs=accepts_a_goal, see="09_arms#base-intro", clauses=[1])
def rejects_a_wrong_place(run: Transcript) -> None:
    """It rejects a place in another frame than odom, and one that holds NaN or infinity"""
    for name, frame in (("wrong frame", "map"), ("no frame", "")):
        run.goal(name).require_rejected(
            because=f"place_pose is in frame {frame!r}",
            help="Compare goal_request.place_pose.header.frame_id with 'odom' in goal_callback.",
        )
    for name in ("NaN place", "infinite place"):
        run.goal(name).require_rejected(
            because="a coordinate of place_pose is not a finite number",
            help="Test x, y and z with math.isfinite() in goal_callback.",
        )


@check(on=IMPOSSIBLE, needs=accepts_a_goal, see="09_arms#force-why", clauses=[1])
def rejects_a_wrong_force(run: Transcript) -> None:
    """It rejects a grasp_force that is NaN, not more than 0 N, or more than 25 N"""
    for name, force in (
        ("NaN force", "NaN"),
        ("no force", "0"),
        ("negative force", "-8"),
        ("too much force", "40"),
    ):
        run.goal(name).require_rejected(
            because=f"no hand can hold with {force} N",
            help="Write `if not 0.0 < goal_request.grasp_force <= 25.0`: every `<` and `>` with NaN is false.",
        )


@check(on=UNKNOWN, needs=accepts_a_goal, see="09_arms#phases-why", clauses=[11, 17])
def knows_no_teapot(run: Transcript) -> None:
    """An object whose pose nobody publishes ends the goal with UNKNOWN_OBJECT after 1 s"""
    goal = run.goal("unknown 1")
    result = require_aborted(
        goal,
        "UNKNOWN_OBJECT",
        because="nothing comes on objects/teapot/pose",
        help="Wait at most 1 s for the first message on objects/<object_id>/pose, then abort.",
    )
    took = result.t - goal.accepted_at
    expect(
        EARLY <= took <= LATE,
        expected="the goal ABORTED after 1 s without a message",
        observed=f"it was after {took:.1f} s",
        help="Give the topic 1 s: its publisher sends 10 messages a second, but has to be found first.",
        at=result.t,
    )


@check(on=FAR_PLACE, needs=accepts_a_goal, see="09_arms#conventions", clauses=[12, 17])
def refuses_a_far_place(run: Transcript) -> None:
    """A place out of reach ends the goal with UNREACHABLE before anything moves"""
    _require_unreachable(run, "the place is beyond the arm's reach")


@check(on=FAR_CUP, needs=accepts_a_goal, see="09_arms#conventions", clauses=[12, 17])
def refuses_a_far_cup(run: Transcript) -> None:
    """A cup out of reach ends the goal with UNREACHABLE before anything moves"""
    _require_unreachable(run, "the cup is beyond the arm's reach")


def _require_unreachable(run: Transcript, because: str) -> None:
    goal = run.goal("far")
    require_aborted(
        goal,
        "UNREACHABLE",
        because=because,
        help="Ask compute_arm_ik for the grasp and for the place before you move; abort unless error_code is SUCCESS "
        "for both.",
    )
    require_nothing_moved(goal)


@check(points=2, on=TAKEN, needs=places_the_cup, see="09_arms#force-why", clauses=[13, 17])
def notices_an_empty_hand(run: Transcript) -> None:
    """When the fingers close on nothing the goal ends with GRASP_FAILED"""
    require_grasp_failed(run.goal("fetch"))


@check(on=TAKEN, needs=notices_an_empty_hand, see="09_arms#force-why", clauses=[13])
def withdraws_an_empty_hand(run: Transcript) -> None:
    """After that the hand is open and withdrawn"""
    result = require_grasp_failed(run.goal("fetch"))
    require_withdrawn(run.goal("fetch"), result.t, taken_from(run.goal("fetch")), opened=OPENED)


@check(points=2, on=SNATCHED, needs=lifts_the_cup, see="09_arms#slip-why", clauses=[15, 17])
def notices_a_lost_cup(run: Transcript) -> None:
    """When the cup is lost while it is lifted the goal ends with DROPPED"""
    require_dropped(run.goal("fetch"))


@check(on=BLOCKED, needs=places_the_cup, see="09_arms#phases-intro", clauses=[14, 17])
def gives_up_when_blocked(run: Transcript) -> None:
    """A hand that does not get to the cup ends the goal with GRASP_FAILED within 20 s"""
    goal = run.goal("fetch")
    held = run.told("hold_joint", joint="r_elbow").t
    result = require_aborted(
        goal,
        "GRASP_FAILED",
        because="the elbow was held, and the hand could not get to the cup",
        help="Something waits without a limit for the hand to arrive. Give each stage a time in which it must be over.",
    )
    expect(
        result.t - held <= PATIENCE,
        expected=f"the goal ABORTED within {PATIENCE:.0f} s",
        observed=f"it was after {result.t - held:.0f} s",
        help="Give each stage a few seconds more than its trajectory takes.",
        at=result.t,
    )


@check(points=2, on=CANCEL, needs=accepts_a_goal, see="07_cancel_and_preempt#m1-why", clauses=[18])
def cancels_before_the_grasp(run: Transcript) -> None:
    """A cancel on the way to the cup ends CANCELED, with the hand withdrawn and the cup where it was"""
    require_left_alone(run.goal("fetch"))


@check(
    points=3,
    on=HOLDING,
    needs=[lifts_the_cup, cancels_before_the_grasp],
    see="09_arms#lift-why",
    clauses=[19],
)
def puts_the_cup_back(run: Transcript) -> None:
    """A cancel soon after the cup was lifted puts it back where it stood, then ends CANCELED"""
    require_put_away(run.goal("fetch"), taken_from(run.goal("fetch")), "where it stood")


@check(points=2, on=TWO, needs=lifts_the_cup, see="07_cancel_and_preempt#preempt-why", clauses=[20])
def has_one_hand(run: Transcript) -> None:
    """Of two goals one has the hand: the second is rejected, or the first ends safely with PREEMPTED"""
    require_preempted_or_rejected(run.goal("first"), run.goal("second"))


@check(on=FALL, needs=accepts_a_goal, see="07_cancel_and_preempt#fall-why", clauses=[16])
def aborts_when_the_robot_falls(run: Transcript) -> None:
    """When the robot falls the goal is ABORTED with FELL"""
    require_aborted_by_a_fall(run.goal("fetch"))


ends_cleanly = standard.ends_cleanly(
    on=INTERRUPT, needs=server_appears, see="07_cancel_and_preempt#conventions", clauses=[21]
)
