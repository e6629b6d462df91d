"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.checks import Scenario, check, expect
from autograder.authoring.fields import expect_field, shown
from autograder.authoring.goal import ABORTED, SUCCEEDED
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

from .child_endings import (
    last_heard,
    require_child_canceled,
    require_finished,
    require_in_order,
    require_no_more,
    require_not_canceled,
    require_nothing_left,
)
from .children import (
    BATTERY,
    children,
    require_child,
    require_pick,
    require_put_aside,
    require_walk_to_the_table,
)
from .fetch_endings import (
    require_abort,
    require_canceled,
    require_failed_child,
    require_patience,
    require_soon,
    require_steps,
    require_success,
)
from .low_battery import (
    require_at_work,
    require_drop,
    require_gave_up_before_the_grasp,
    require_home_after,
    require_stage,
)

CUP = {"object_id": "cup", "place": [0.4, -0.1, 0.75], "force": 12.0}  # m in odom, N

INTERRUPT = Scenario("interrupt", robot=None)
GOOD = Scenario("good", {"goal": CUP, "levels": [0.71, 0.55, 0.32]}, robot=None)
IMPOSSIBLE = Scenario("ask_for_the_impossible", robot=None)
LOW_BEFORE = Scenario("low_before", {"level": 0.12, "then": 0.9}, robot=None)
TO_THE_TABLE = Scenario("drop", {"moment": "to the table", "level": 0.17}, robot=None)
HOLDING = Scenario("drop", {"moment": "lifting the cup", "level": 0.15}, robot=None)
CANCELED_WALK = Scenario("cancel", {"moment": "to the table", "canceled_after": 1.5}, robot=None)
REJECTED = Scenario("fail", {"step": 1, "how": "rejected"}, robot=None)
ABORTED_WALK = Scenario(
    "fail", {"step": 1, "how": "aborted", "code": 3, "message": "the way took longer than 48 s"}, robot=None
)
ABORTED_GRASP = Scenario(
    "fail", {"step": 2, "how": "aborted", "code": 3, "message": "the fingers closed on nothing"}, robot=None
)
SILENT = Scenario("fail", {"step": 1, "how": "silent"}, robot=None)

DEADLOCK = "11_capstone#blocked-why"
ORPHANS = "11_capstone#patient-why"
GOES_DOWN = "11_capstone#careful-why"
GIVES_UP = "11_capstone#ways-why"
BATTERY_LESSON = "08_navigation#guard-traps-why"
SILENCE_LESSON = "11_capstone#dead-why"
REJECTS = "07_cancel_and_preempt#conventions"

server_appears = standard.server_appears(
    "the action fetch", points=1, on=INTERRUPT, see="07_cancel_and_preempt#fix-file", clauses=[31]
)


@check(points=1, on=GOOD, needs=server_appears, see=DEADLOCK, clauses=[1])
def goes_to_the_table(run: Transcript) -> None:
    """It accepts a goal, and sends the robot to the table"""
    goal = run.goal("fetch")
    require_walk_to_the_table(require_child(goal, 1))


@check(points=2, on=GOOD, needs=goes_to_the_table, see=DEADLOCK, clauses=[1, 2, 4, 29])
def takes_the_object(run: Transcript) -> None:
    """When the robot has arrived, it has the object put onto the tray"""
    goal = run.goal("fetch")
    child = require_child(goal, 2)
    require_finished(goal, require_child(goal, 1), SUCCEEDED)
    require_in_order(goal)
    require_pick(child, goal.request)
    require_put_aside(child, goal.request)


@check(points=2, on=GOOD, needs=takes_the_object, see=DEADLOCK, clauses=[1, 3, 4, 5])
def fetches(run: Transcript) -> None:
    """It comes home, puts the object down, and then SUCCEEDS"""
    goal = run.goal("fetch")
    require_steps(goal)
    require_success(goal)


@check(points=1, on=GOOD, needs=fetches, see="07_cancel_and_preempt#m13-why", clauses=[6])
def fills_the_result(run: Transcript) -> None:
    """The result tells where the object ended, the largest force, and error_code NONE"""
    goal = run.goal("fetch")
    require_success(goal)
    finished = require_finished(goal, require_child(goal, 4), SUCCEEDED)
    because = "pick_and_place says so in its result"
    help = "Take response.result of the last pick_and_place, and fill your result before succeed()."
    for axis in "xyz":
        path = f"final_object_pose.pose.position.{axis}"
        goal.expect(
            path,
            getattr(finished.result.final_object_pose.pose.position, axis),
            because=because,
            help=help,
        )
    goal.expect("max_grasp_force", finished.result.max_grasp_force, because=because, help=help)
    goal.expect("error_code", 0, because="nothing went wrong", help="NONE is 0, the default.")


@check(points=1, on=GOOD, needs=takes_the_object, see="06_walk_to_a_pose#slow-why", clauses=[7])
def passes_feedback_on(run: Transcript) -> None:
    """What pick_and_place says of its stage, fetch says in its own feedback, in order and within 1 s"""
    goal = run.goal("fetch")
    arm = [child for child in children(goal) if child.received.action == "pick_and_place"]
    published = [event for child in arm for event in child.feedback]
    if len(published) < 6:
        raise unseen(run, "pick_and_place published no feedback")
    heard = iter(goal.feedback)
    for event in published:
        match = next((f for f in heard if f.feedback.stage == event.feedback.stage and f.t >= event.t), None)
        expect(
            match is not None and match.t - event.t <= 1.0,
            expected=f"feedback of fetch with stage {shown(event.feedback.stage)} within 1 s of pick_and_place's",
            observed="none" if match is None else f"{match.t - event.t:.1f} s after it",
            help="Give send_goal_async a feedback_callback that calls goal_handle.publish_feedback(message.feedback).",
            at=event.t,
        )


@check(points=1, on=IMPOSSIBLE, needs=goes_to_the_table, see=REJECTS, clauses=[8])
def rejects_what_is_knowably_wrong(run: Transcript) -> None:
    """It rejects a place in frame map, NaN, and a force that is not above 0"""
    because = {
        "wrong frame": "the robot knows no frame 'map'",
        "NaN position": "nothing can be put down at NaN",
        "NaN force": "NaN is no force",
        "no force": "nothing can be held with 0 N",
    }
    for name, why in because.items():
        run.goal(name).require_rejected(
            because=why,
            help="Test frame_id, then every number with math.isfinite(), and grasp_force > 0, in goal_callback.",
        )


@check(points=1, on=LOW_BEFORE, needs=goes_to_the_table, see=BATTERY_LESSON, clauses=[10, 17])
def does_not_set_out_on_a_low_battery(run: Transcript) -> None:
    """With the battery at 0.12 it sends no goal to anybody, and ends ABORTED naming the battery"""
    goal = run.goal("low battery")
    published = run.published(BATTERY)
    if not published or published[0].t > goal.sent.t or published[0].message.percentage >= 0.20:
        raise unseen(run, "the battery was not low")
    goal.require_accepted(
        "A rejection carries no reason: accept the goal, and abort it with error_msg naming the battery."
    )
    require_no_more(goal, 0, "the battery was at 0.12 before")
    require_abort(goal, "battery", because="it was at 0.12")


@check(
    points=2,
    on=[REJECTED, ABORTED_WALK, ABORTED_GRASP],
    needs=goes_to_the_table,
    see=ORPHANS,
    clauses=[22, 25, 26],
)
def says_why_a_child_failed(rejected: Transcript, walk: Transcript, grasp: Transcript) -> None:
    """A child that is rejected or aborts ends fetch ABORTED; error_msg names the action and holds the child's reason"""
    goal = rejected.goal("fetch")
    child = require_child(goal, 1)
    if not child.reply or child.reply.accepted:
        raise unseen(rejected, "the walk was not rejected")
    require_failed_child(goal, 1, because="it rejected its goal")
    require_soon(goal, child.reply.t, "the rejection")
    for run, step in ((walk, 1), (grasp, 2)):
        goal = run.goal("fetch")
        finished = require_finished(goal, require_child(goal, step), ABORTED)
        said = run.params["message"]
        require_failed_child(goal, step, said, because=f"it was aborted with error_msg {shown(said)}")
        require_soon(goal, finished.t, "the child's end")
        if run is grasp:
            expect_field(
                goal.require_result(ABORTED).result,
                "error_code",
                run.params["code"],
                because="pick_and_place was aborted with this code, and fetch has the same codes",
                help="Copy error_code from the child's result into yours.",
                at=finished.t,
            )


@check(points=2, on=SILENT, needs=goes_to_the_table, see=SILENCE_LESSON, clauses=[23, 25, 27, 29])
def cancels_a_silent_child(run: Transcript) -> None:
    """A child that is silent for 5 s is canceled; when it has ended, fetch ends ABORTED naming the action"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    heard = last_heard(child)
    require_child_canceled(
        goal,
        child,
        heard,
        "nothing was heard of it for 5 s, and a robot that walks for nobody is a danger",
        within=5.0 + 2.5,
    )
    require_patience(goal, child, heard, "no feedback and no result")
    require_failed_child(goal, 1, because="it was silent for 5 s")
    require_nothing_left(goal)


@check(points=3, on=CANCELED_WALK, needs=goes_to_the_table, see=GOES_DOWN, clauses=[18, 20, 21])
def cancel_goes_down(run: Transcript) -> None:
    """A cancel goes down to the child at work, and fetch is CANCELED when the child has ended"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    require_at_work(run, child, goal.requests_to_cancel[-1].sent.t, "fetch was canceled")
    require_canceled(goal, child)
    require_no_more(goal, 1, "fetch was canceled")


@check(points=3, on=TO_THE_TABLE, needs=goes_to_the_table, see=GIVES_UP, clauses=[11, 12, 17])
def gives_up_before_the_grasp(run: Transcript) -> None:
    """When the battery drops before the grasp, it cancels the child, waits for its end, goes home, and is ABORTED"""
    require_gave_up_before_the_grasp(run.goal("fetch"), 1)


@check(points=3, on=HOLDING, needs=takes_the_object, see=GIVES_UP, clauses=[13, 15, 17])
def finishes_placing_first(run: Transcript) -> None:
    """When the battery drops while the hand holds the object, it is placed first; then home, and ABORTED"""
    goal = run.goal("fetch")
    child = require_child(goal, 2)
    drop = require_drop(run)
    require_at_work(run, child, drop.t, "the battery dropped")
    require_stage(run, child, drop.t, "lifting")
    require_not_canceled(
        child,
        "the hand holds the object",
        "Keep the stage of pick_and_place's last feedback: from lifting on, wait for its result.",
    )
    require_finished(goal, child, SUCCEEDED)
    require_in_order(goal)
    because = f"the battery fell to {drop.message.percentage:.2f} while the object was lifted"
    require_home_after(goal, 2, because)
    require_no_more(goal, 3, "the battery is low: the object stays on the tray")
    require_abort(goal, "battery", because=because)
    require_nothing_left(goal)


ends_cleanly = standard.ends_cleanly(points=1, on=INTERRUPT, needs=server_appears, clauses=[31])
