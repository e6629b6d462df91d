"""What only the instructor's grading checks."""

from __future__ import annotations

import math

from autograder.authoring.arms.motion import (
    require_arrival,
    require_moving,
    require_points_passed,
    require_stopped,
)
from autograder.authoring.arms.reports import require_aborted, require_true_feedback
from autograder.authoring.arms.truth import joints_at, require_accepted
from autograder.authoring.checks import Scenario, check, expect
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

from .checks import (
    BLOCK,
    aborts_when_the_arm_is_blocked,
    aborts_when_the_end_is_missed,
    arrives,
    feedback_is_true,
    moves_both_arms,
    passes_every_point,
    rejects_out_of_range,
    stops_when_canceled,
)
from .judging import require_held_short, require_released_in_time, require_spared

ROLL = (
    math.radians(-120),
    math.radians(20),
)  # rad, of r_shoulder_roll; the left one's range is its mirror image
BEYOND = 0.08  # rad


def _ends(random) -> dict:
    """Positions just outside the range of the right shoulder_roll, one inside it, and the point that has it."""
    low, high = ROLL
    return {
        "arm": "r",
        "joint": "r_shoulder_roll",
        "inside": round(random.uniform(-0.9, -0.5), 3),
        "outside": [round(low - BEYOND, 3), round(high + BEYOND, 3)],
        "at": random.randrange(3),
    }


def _anywhere(random) -> dict:
    """Three points within reach of the right arm, two of them within the same second, no faster than 0.8 rad/s."""
    elbow = [random.uniform(-1.5, -1.0), random.uniform(-1.0, -0.5)]
    pitch = [random.uniform(-0.6, -0.2), random.uniform(-0.2, 0.3)]
    wrist = [random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)]
    first, last = zip(wrist, elbow, pitch, strict=True)
    between = [before + 0.3 * (after - before) for before, after in zip(first, last, strict=True)]
    points = [
        [t, [round(position, 3) for position in each]]
        for t, each in ((2.0, first), (2.8, between), (4.4, last))
    ]
    return {"arm": "r", "joints": ["r_wrist_pitch", "r_elbow", "r_shoulder_pitch"], "points": points}


ANYWHERE = Scenario("move", _anywhere)
REVERSED = Scenario(
    "move_by_reversed_states",
    {"arm": "r", "joints": ["r_wrist_pitch", "r_elbow"], "points": [[2.0, [0.4, -1.2]]]},
)
ENDS = Scenario("ask_at_the_ends_of_a_range", _ends)
GENEROUS = Scenario("hold_short", {"goal_tolerance": 0.45})
IN_TIME = Scenario("let_go_in_time", {"late": 0.4})
AT_THE_START = Scenario("cancel_at_the_start")
AGAIN = Scenario("cancel_and_move_again", lambda random: {"elbow": round(random.uniform(-0.4, -0.2), 3)})
ONE_OF_TWO = Scenario("cancel_one_of_two")
LOST = Scenario("lose_the_joint_states")
OTHER_NAMESPACE = Scenario(
    "move", {"arm": "l", "joints": ["l_elbow"], "points": [[1.5, [-1.0]]]}, namespace="/lab_7/robot"
)
SILENT = "Remember when the last joint_states came, and give up when that is more than 1 s ago."
QUIET = 0.8  # s without joint_states before which nobody may give up
GIVEN_UP = 3.0  # s


@check(points=2, on=ANYWHERE, needs=[arrives, passes_every_point], see="09_arms#clock-why", clauses=[1, 6, 7])
def moves_the_right_arm(run: Transcript) -> None:
    """It moves the right arm, too, through points that are drawn"""
    goal = run.goal("move")
    require_accepted(
        goal,
        "Two of its points are less than a second apart: compare time_from_start.sec + time_from_start.nanosec * 1e-9.",
    )
    require_arrival(goal)
    require_points_passed(goal)


@check(points=1, on=REVERSED, needs=arrives, see="02_services#first-file", clauses=[7])
def reads_joint_states_by_name(run: Transcript) -> None:
    """It measures by the joints' names, in whatever order joint_states lists them"""
    run.told("joint_states", before=run.goal("move").sent.t, reversed=True)
    require_arrival(
        run.goal("move"),
        given_up="joint_states listed the joints in another order than before. Pair message.name with message.position "
        "anew in each message, and look each joint up by its name.",
    )


@check(points=2, on=ENDS, needs=rejects_out_of_range, see="09_arms#silent-why", clauses=[1, 5])
def knows_each_joints_range(run: Transcript) -> None:
    """It knows the range of each joint: a little outside is rejected, at any point, inside is accepted"""
    joint = run.params["joint"]
    for number, position in enumerate(run.params["outside"], start=1):
        run.goal(f"outside {number}").require_rejected(
            because=f"{joint} cannot get to {position:.2f} rad (point {run.params['at']})",
            help="Look at every position of every point, and take lower and upper of this very joint from "
            "joint_limits: the right arm's ranges mirror the left one's.",
        )
    run.goal("inside").require_accepted(
        f"{run.params['inside']:.2f} rad is within the range of {joint}: take lower and upper of this very joint from "
        "joint_limits."
    )


@check(
    points=1,
    on=BLOCK,
    needs=[aborts_when_the_arm_is_blocked, feedback_is_true],
    see="09_arms#bend-why",
    clauses=[13],
)
def feedback_shows_a_blocked_arm(run: Transcript) -> None:
    """max_error grows while the arm is blocked"""
    run.told("hold_joint", joint="l_elbow")
    require_true_feedback(run.goal("move"))


@check(points=1, on=GENEROUS, needs=aborts_when_the_end_is_missed, see="09_arms#bend-why", clauses=[7])
def obeys_goal_tolerance(run: Transcript) -> None:
    """A joint within goal_tolerance of its end is near enough"""
    require_held_short(run.goal("move"), "l_elbow")
    require_arrival(run.goal("move"))


@check(points=1, on=IN_TIME, needs=aborts_when_the_end_is_missed, see="09_arms#bend-why", clauses=[7])
def waits_a_second_for_the_end(run: Transcript) -> None:
    """A joint that gets to its end within 1 s of its time is in time"""
    require_released_in_time(run.goal("move"), "l_elbow")
    require_arrival(run.goal("move"))


@check(points=1, on=AT_THE_START, needs=stops_when_canceled, see="07_cancel_and_preempt#m1-why", clauses=[14])
def cancels_at_the_start(run: Transcript) -> None:
    """A cancel right after the acceptance ends CANCELED with the arm still"""
    goal = run.goal("move").require_accepted()
    cancel = goal.requests_to_cancel[-1]
    if cancel.answer:
        expect(
            goal.name in cancel.answer.canceling,
            expected="the server to agree to cancel, as it does later on",
            observed=f"it refused {cancel.answer.t - goal.accepted_at:.1f} s after the acceptance",
            help="Return CancelResponse.ACCEPT at any moment: before the arm moves there is a trajectory to take back, "
            "too.",
            at=cancel.answer.t,
        )
    request = goal.require_canceled()
    require_stopped(run, ["l_elbow", "l_wrist_pitch"], request.t)


@check(
    points=1,
    on=AGAIN,
    needs=[stops_when_canceled, arrives],
    see="07_cancel_and_preempt#fix-intro",
    clauses=[7],
)
def moves_again_after_a_cancel(run: Transcript) -> None:
    """A new goal after a cancel is carried out"""
    require_moving(run, "l_elbow", run.goal("canceled").requests_to_cancel[-1].sent.t)
    require_arrival(run.goal("again"))


@check(
    points=2,
    on=ONE_OF_TWO,
    needs=[stops_when_canceled, moves_both_arms],
    see="09_arms#replace-why",
    clauses=[14, 16],
)
def a_cancel_spares_the_other_arm(run: Transcript) -> None:
    """When one arm's goal is cancelled, that arm stops and the other goes on"""
    request = run.goal("left").require_canceled()
    require_moving(run, "l_elbow", request.t)
    require_moving(run, "r_elbow", request.t)
    require_stopped(run, ["l_elbow", "l_wrist_pitch"], request.t)
    require_spared(run.goal("right"))


@check(points=1, on=LOST, needs=arrives, see="09_arms#conventions", clauses=[12])
def aborts_without_joint_states(run: Transcript) -> None:
    """When joint_states say nothing for 1 s the goal ends with INVALID_JOINTS and the arm stops"""
    goal = run.goal("move")
    lost = run.told("joint_sensors", connected=False).t
    require_moving(run, "l_elbow", lost)
    result = require_aborted(
        goal,
        "INVALID_JOINTS",
        because="nothing is known of the joints any more",
        help=SILENT,
        other_code=SILENT,
    )
    expect(
        QUIET <= result.t - lost <= GIVEN_UP,
        expected="the goal ABORTED 1 s after the last joint_states",
        observed=f"{result.t - lost:.1f} s after it",
        help="Compare the time of the last joint_states with now, in every round.",
        at=result.t,
    )
    end = joints_at(run, run.end).positions["l_elbow"]
    stopped = joints_at(run, min(result.t + 0.5, run.end)).positions["l_elbow"]
    if run.end < result.t + 1.0:
        raise unseen(run, "nobody watched the arm after the result")
    expect(
        abs(end - stopped) < 0.05,
        expected="an arm that stays where it is when the goal is given up",
        observed=f"l_elbow went on by {abs(end - stopped):.2f} rad",
        help="Publish an empty JointTrajectory() before abort(): hold.",
        at=run.end,
    )


@check(points=1, on=OTHER_NAMESPACE, needs=arrives, see="01_robot_and_graph#names-why", clauses=[17])
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it moves the arm of the robot there"""
    require_arrival(run.goal("move"))
