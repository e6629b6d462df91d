"""The requirements on hand and cup, and the failures of servers that violate them."""

from __future__ import annotations

from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Point, PoseStamped

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged
from autograder.engine.exercise import load_exercise
from humanoid_interfaces.action import PickAndPlace
from records import failure_of, robot, run_of

EXERCISE = load_exercise("pick_and_place", hidden=True)
CHECKS = {check.id: check for check in EXERCISE.checks}
HOME, PLACE, TABLE = (0.33, -0.15), (0.35, -0.27), 0.755
BEGIN, LIFT, CARRY, LOWER, FREE, END, LAST = 2.0, 5.0, 6.0, 8.0, 9.0, 11.0, 12.6  # s
STAGES = {
    0.0: "approaching",
    4.0: "grasping",
    LIFT: "lifting",
    CARRY: "moving",
    LOWER: "placing",
    FREE: "retreating",
}


def cup_at(t: float) -> tuple[float, float, float]:
    share = min(1.0, max(0.0, (t - CARRY) / (LOWER - CARRY)))
    x, y = (a + share * (b - a) for a, b in zip(HOME, PLACE, strict=True))
    up = 0.12 * min(1.0, max(0.0, t - LIFT), max(0.0, FREE - t))
    return x, y, TABLE + up


def hand_at(t: float) -> tuple[float, float, float]:
    x, y, z = cup_at(t)
    away = 0.2 if t < 3.5 or t > FREE + 0.8 else 0.0
    return x - away, y, z + 0.01


def stamped(position: tuple[float, float, float]) -> PoseStamped:
    x, y, z = position
    pose = PoseStamped()
    pose.header.frame_id = "odom"
    pose.pose.position = Point(x=x, y=y, z=z)
    return pose


def force_at(t: float, force: float = 10.0) -> float:
    return force if 4.5 < t < FREE else 0.0


def stage_at(t: float) -> str:
    return STAGES[max(begin for begin in STAGES if begin <= t)]


def fetched(**change: Any) -> Transcript:
    """A run in which everything went well, but for what is changed.

    Args:
        change: cup, hand: where they are at a time; force: N at a time; tell: makes a feedback message of a time;
            result: fields of the result; status: of the goal; more: other events.
    """
    cup, hand = change.get("cup", cup_at), change.get("hand", hand_at)
    force = change.get("force", force_at)

    def tell(t: float) -> PickAndPlace.Feedback:
        return PickAndPlace.Feedback(
            stage=stage_at(t),
            percent_complete=100.0 * t / END,
            hand_pose=stamped(hand(t)),
            distance_to_object=sum((a - b) ** 2 for a, b in zip(hand(t), cup(t), strict=True)) ** 0.5,
            grasp_force=force(t),
        )

    events: list[Any] = [
        ev.GoalSent(
            t=BEGIN - 0.1,
            goal="fetch",
            action="pick_and_place",
            request=PickAndPlace.Goal(object_id="cup", place_pose=stamped((*PLACE, TABLE)), grasp_force=10.0),
        ),
        ev.GoalAnswered(t=BEGIN, goal="fetch", accepted=True),
        *change.get("more", ()),
    ]
    for tick in range(round(50 * LAST)):
        t = 0.02 * tick
        opening = 0.06 if force(t) else 0.09 if t > BEGIN else 0.0
        events += [
            robot(t),
            ev.HandTruth(t=t, side="r", position=list(hand(t)), opening=opening, forces=[force(t), force(t)]),
            ev.ObjectTruth(t=t, name="cup", position=list(cup(t)), up=change.get("up", 1.0), speed=0.0),
            ev.JointsTruth(t=t, positions={"r_elbow": hand(t)[0]}, velocities={"r_elbow": 0.0}),
        ]
        if BEGIN < t < END and tick % 10 == 0:
            events.append(
                ev.FeedbackReceived(
                    t=t, goal="fetch", feedback=change.get("tell", lambda _, say: say)(t, tell(t))
                )
            )
    result = {
        "final_object_pose": stamped((PLACE[0] + 0.002, PLACE[1], TABLE)),
        "max_grasp_force": 10.0,
    } | change.get("result", {})
    status = change.get("status", GoalStatus.STATUS_SUCCEEDED)
    events.append(ev.ResultReceived(t=END, goal="fetch", status=status, result=PickAndPlace.Result(**result)))
    return run_of(*sorted(events, key=lambda event: event.t), until=LAST)


def set_field(name: str, value: Any) -> Any:
    def tell(t: float, feedback: PickAndPlace.Feedback) -> PickAndPlace.Feedback:
        setattr(feedback, name, value(t) if callable(value) else value)
        return feedback

    return tell


OF_A_FETCH = [
    *("accepts_a_goal", "places_the_cup", "lifts_the_cup", "keeps_the_force", "fills_the_result"),
    *("feedback_keeps_its_rate", "names_its_stages", "stages_are_true", "feedback_is_measured"),
    *("percentage_rises", "feedback_ends_with_the_goal"),
]


@pytest.mark.parametrize("check", OF_A_FETCH)
def test_a_correct_fetch_passes(check: str) -> None:
    CHECKS[check].run([fetched()])


@pytest.mark.parametrize(
    ("check", "change", "words"),
    [
        ("places_the_cup", {"cup": lambda t: (*HOME, cup_at(t)[2])}, "The cup is where it was"),
        ("places_the_cup", {"cup": lambda t: (*cup_at(t)[:2], TABLE)}, ""),
        ("places_the_cup", {"up": 0.1}, "Lower the cup until it touches the table"),
        ("places_the_cup", {"hand": lambda t: cup_at(t)}, "move it back"),
        ("lifts_the_cup", {"cup": lambda t: (*cup_at(t)[:2], TABLE)}, "move it straight up"),
        ("keeps_the_force", {"force": lambda t: force_at(t, 24.0)}, "is an opening in m, not a force"),
        ("keeps_the_force", {"force": lambda t: force_at(t, 3.0)}, "is an opening in m, not a force"),
        ("fills_the_result", {"result": {"final_object_pose": PoseStamped()}}, "objects/cup/pose"),
        ("fills_the_result", {"result": {"final_object_pose": stamped((*PLACE, TABLE))}}, "objects/cup/pose"),
        ("fills_the_result", {"result": {"max_grasp_force": 0.0}}, "largest force.y"),
        ("fills_the_result", {"result": {"error_msg": "done"}}, "only when the goal is aborted"),
        ("names_its_stages", {"tell": set_field("stage", "MOVING")}, "constants of PickAndPlace.Feedback"),
        ("names_its_stages", {"tell": set_field("stage", "moving")}, "Set feedback.stage once"),
        (
            "stages_are_true",
            {"tell": set_field("stage", lambda t: stage_at(t + 1.8))},
            "when the stage begins",
        ),
        ("feedback_is_measured", {"tell": set_field("hand_pose", PoseStamped())}, "r_hand/pose"),
        (
            "feedback_is_measured",
            {"tell": set_field("distance_to_object", 1.0)},
            "the distance in x, y and z",
        ),
        ("feedback_is_measured", {"tell": set_field("grasp_force", 10.0)}, "not the goal's grasp_force"),
        (
            "percentage_rises",
            {"tell": set_field("percent_complete", lambda t: t / END)},
            "from 0 to 100, not a share",
        ),
        ("percentage_rises", {"tell": set_field("percent_complete", lambda t: 90.0 - t)}, "its own range"),
    ],
)
def test_a_faulty_fetch_fails_with_its_next_step(check: str, change: dict, words: str) -> None:
    if not words:  # the cup was pushed along the table, which another check forbids
        CHECKS[check].run([fetched(**change)])
        return
    assert words in failure_of(CHECKS[check].run, [fetched(**change)]).help


def commanded(t: float, **command: Any) -> list[Any]:
    return [ev.CommandSent(t=t, command=command), ev.RobotCommanded(t=t, command=command)]


def aborted(code: int, *more: Any, **change: Any) -> Transcript:
    result = {"error_code": code, "error_msg": "no"} | change.pop("result", {})
    return fetched(more=more, status=GoalStatus.STATUS_ABORTED, result=result, **change)


TAKEN = commanded(7.01, do="move_object", name="cup", position=[0.5, 0.3, TABLE])


def lost(t: float) -> tuple[float, float, float]:
    return cup_at(t) if t < 7.01 else (0.5, 0.3, TABLE)


def test_a_lost_cup_ends_with_its_code() -> None:
    CHECKS["notices_a_lost_cup"].run([aborted(PickAndPlace.Result.DROPPED, *TAKEN, cup=lost)])
    wrong = aborted(PickAndPlace.Result.GRASP_FAILED, *TAKEN, cup=lost)
    assert "DROPPED" in failure_of(CHECKS["notices_a_lost_cup"].run, [wrong]).expected
    silent = aborted(PickAndPlace.Result.DROPPED, *TAKEN, cup=lost, result={"error_msg": " "})
    assert "why the goal was ABORTED" in failure_of(CHECKS["notices_a_lost_cup"].run, [silent]).expected
    happy = fetched(more=TAKEN, cup=lost)
    assert (
        "check force.y of r_gripper/wrench in every round"
        in failure_of(CHECKS["notices_a_lost_cup"].run, [happy]).help
    )


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (PickAndPlace.Result.UNKNOWN_OBJECT, "no callback runs while execute"),
        (PickAndPlace.Result.GRASP_FAILED, "only when it is open around the cup"),
        (PickAndPlace.Result.DROPPED, "before you lift"),
        (77, "find out why your server aborted it"),
    ],
)
def test_for_a_server_that_gives_up_its_own_reason_is_quoted(code: int, words: str) -> None:
    failure = failure_of(CHECKS["places_the_cup"].run, [aborted(code)])
    assert words in failure.help
    assert "'no'" in failure.observed


def test_if_the_cup_was_never_removed_the_check_does_not_pass() -> None:
    never = aborted(PickAndPlace.Result.DROPPED)
    with pytest.raises(CannotBeJudged):
        CHECKS["notices_a_lost_cup"].run([never])


def test_nothing_may_move_before_a_goal_is_known_to_be_possible() -> None:
    run = aborted(PickAndPlace.Result.UNREACHABLE)
    run.goal("fetch").request.place_pose.pose.position.x = 0.75
    assert "r_elbow moved by" in failure_of(CHECKS["refuses_a_far_place"].run, [run]).observed
