"""A fetch is judged by its child goals, on records made by hand: a correct server and slightly faulty ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce
from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from sensor_msgs.msg import BatteryState

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, Failure
from autograder.engine.exercise import load_exercise
from humanoid_interfaces.action import NavigateToPose, PickAndPlace
from records import failure_of

CHECKS = {check.id: check for check in load_exercise("low_battery_fetch", hidden=True).checks}
SERVERS = {"navigate_to_pose": "server 1", "pick_and_place": "server 2"}
SUCCEEDED, CANCELED = GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_CANCELED
ABORTED = GoalStatus.STATUS_ABORTED
TABLE, TRAY, HOME, PLACE = (1.2, 0.0, 0.0), (1.45, 0.0, 0.72), (0.0, 0.0, 0.0), (0.4, -0.1, 0.75)
FULL = ev.MessagePublished(
    t=0.2, topic="battery_state", message=BatteryState(percentage=0.8), subscriptions=0
)
STARTED = [
    *(ev.ActionOffered(t=0.1, action=action, server=server, type="") for action, server in SERVERS.items()),
    *(FULL, ev.NodeStarted(t=0.3), ev.NodeReady(t=0.5, waited=0.5)),
]
OVER = [ev.ScenarioEnded(t=60.0)]


def put(message: Any, place: Sequence[float]) -> Any:
    pose = message.pose if isinstance(message, NavigateToPose.Goal) else message.place_pose
    pose.header.frame_id = "odom"
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = place
    pose.pose.orientation.w = 1.0
    return message


def fetch(sent: float, ended: float, status: int, message: str = "") -> list[Any]:
    result = PickAndPlace.Result(error_msg=message)
    return [
        ev.GoalSent(t=sent, goal="fetch", action="fetch", request=arm(PLACE)),
        ev.GoalAnswered(t=sent + 0.1, goal="fetch", accepted=True),
        ev.ResultReceived(t=ended, goal="fetch", status=status, result=result),
    ]


def walk(place: Sequence[float]) -> Any:
    return put(NavigateToPose.Goal(), place)


def arm(place: Sequence[float]) -> Any:
    return put(PickAndPlace.Goal(object_id="cup", grasp_force=12.0), place)


def child(number: int, message: Any, sent: float, ended: float | None, status: int = SUCCEEDED) -> list[Any]:
    action = "navigate_to_pose" if isinstance(message, NavigateToPose.Goal) else "pick_and_place"
    name = f"goal {number}"
    events = [
        ev.GoalReceived(t=sent, goal=name, action=action, server=SERVERS[action], message=message),
        ev.GoalReplySent(t=sent + 0.05, goal=name, accepted=True),
    ]
    if ended is not None:
        result = NavigateToPose.Result() if action == "navigate_to_pose" else PickAndPlace.Result()
        events += [
            ev.GoalFinished(t=ended, goal=name, status=status, result=result),
            ev.ResultSent(t=ended, goal=name),
        ]
    return events


def cancel(t: float, number: int = 1, action: str = "navigate_to_pose") -> list[Any]:
    name, goal = f"cancel of {number}", f"goal {number}"
    return [
        ev.CancelReceived(t=t, cancel=name, action=action, server=SERVERS[action], goal=goal),
        ev.CancelReplySent(t=t, cancel=name, return_code=0, canceling=[goal]),
    ]


def canceled_fetch(t: float) -> list[Any]:
    return [
        ev.CancelSent(t=t, cancel="cancel 1", goal="fetch", by="client"),
        ev.CancelAnswered(t=t + 0.1, cancel="cancel 1", return_code=0, canceling=["fetch"]),
    ]


def drop(t: float, level: float = 0.17, subscriptions: int = 1) -> list[Any]:
    message = BatteryState(percentage=level)
    return [ev.MessagePublished(t=t, topic="battery_state", message=message, subscriptions=subscriptions)]


def judge(check: str, *parts: list[Any]) -> None:
    events = [event for part in (STARTED, *parts, OVER) for event in part]
    CHECKS[check].run([Transcript.from_events("fetch", {}, events)])


def failure(check: str, *parts: list[Any]) -> Failure:
    return failure_of(judge, check, *parts)


FOUR = [
    child(1, walk(TABLE), 1.2, 3.2),
    child(2, arm(TRAY), 3.3, 5.3),
    child(3, walk(HOME), 5.4, 7.4),
    child(4, arm(PLACE), 7.5, 9.5),
]
GAVE_UP = [drop(2.0), cancel(2.1), child(1, walk(TABLE), 1.2, 3.1, CANCELED), child(2, walk(HOME), 3.2, 5.2)]


def test_four_children_in_order_are_a_fetch() -> None:
    judge("fetches", fetch(1.0, 9.6, SUCCEEDED), *FOUR)


def test_an_end_before_that_of_the_last_child_leaves_it_at_work() -> None:
    assert "still active" in failure("fetches", fetch(1.0, 9.0, SUCCEEDED), *FOUR).observed


def test_two_children_at_once_are_no_fetch() -> None:
    early = [*FOUR[:2], child(3, walk(HOME), 5.0, 7.4), FOUR[3]]
    assert (
        "while pick_and_place was still active"
        in failure("fetches", fetch(1.0, 9.6, SUCCEEDED), *early).observed
    )


def test_giving_up_before_the_grasp() -> None:
    judge("gives_up_before_the_grasp", fetch(1.0, 5.3, ABORTED, "the battery is low"), *GAVE_UP)


@pytest.mark.parametrize(
    ("parts", "observed"),
    [
        ([fetch(1.0, 5.3, ABORTED, "too tired"), *GAVE_UP], "error_msg: 'too tired'"),
        ([fetch(1.0, 5.0, ABORTED, "battery"), *GAVE_UP], "still active"),
        ([fetch(1.0, 3.3, ABORTED, "battery"), *GAVE_UP[:3]], "the result of fetch, ABORTED"),
        (
            [fetch(1.0, 5.3, ABORTED, "battery"), *GAVE_UP[:3], child(2, walk(HOME), 2.9, 5.2)],
            "while navigate_to_pose",
        ),
        ([fetch(1.0, 5.3, ABORTED, "battery"), *GAVE_UP, cancel(3.5, 2)], "a cancel request"),
        ([fetch(1.0, 5.3, ABORTED, "battery"), drop(2.0, subscriptions=0), *GAVE_UP[1:]], "no subscription"),
    ],
    ids=["no reason", "too early", "not home", "home too early", "home is canceled", "no subscription"],
)
def test_near_misses_of_giving_up(parts: list[list[Any]], observed: str) -> None:
    assert observed in failure("gives_up_before_the_grasp", *parts).observed


def test_without_a_drop_of_the_battery_the_check_does_not_pass() -> None:
    with pytest.raises(CannotBeJudged):
        judge("gives_up_before_the_grasp", fetch(1.0, 9.6, SUCCEEDED), *FOUR)


def test_a_fetch_that_ends_before_the_battery_drops_was_not_under_way() -> None:
    early = failure("gives_up_before_the_grasp", fetch(1.0, 2.5, SUCCEEDED), child(1, walk(TABLE), 1.2, 3.1))
    assert "SUCCEEDED while navigate_to_pose was still active" in early.observed


def test_a_cancel_is_passed_to_the_child_which_ends_first() -> None:
    asked, at_work = [canceled_fetch(2.0), cancel(2.1)], child(1, walk(TABLE), 1.2, 3.6, CANCELED)
    judge("cancel_goes_down", fetch(1.0, 3.7, CANCELED), *asked, at_work)
    assert "still active" in failure("cancel_goes_down", fetch(1.0, 2.3, CANCELED), *asked, at_work).observed
    left = [canceled_fetch(2.0), child(1, walk(TABLE), 1.2, None)]
    assert failure("cancel_goes_down", fetch(1.0, 2.3, CANCELED), *left).observed == "no request"


@pytest.mark.parametrize(
    ("check", "number", "path", "value"),
    [
        ("goes_to_the_table", 0, "pose.pose.position.y", 0.2),
        ("goes_to_the_table", 0, "pose.pose.orientation.w", 0.0),
        ("takes_the_object", 1, "place_pose.pose.position.z", 0.7),
        ("takes_the_object", 1, "object_id", "mug"),
        ("fetches", 2, "pose.header.frame_id", "map"),
        ("fetches", 3, "place_pose.pose.orientation.z", 0.5),
        ("fetches", 3, "grasp_force", 11.9),
    ],
)
def test_each_field_of_a_childs_goal_counts(check: str, number: int, path: str, value: Any) -> None:
    messages = [walk(TABLE), arm(TRAY), walk(HOME), arm(PLACE)]
    *way, last = path.split(".")
    setattr(reduce(getattr, way, messages[number]), last, value)
    sent = [child(n, each, 2.0 * n, 2.0 * n + 1.9) for n, each in enumerate(messages, start=1)]
    assert path in failure(check, fetch(1.0, 10.0, SUCCEEDED), *sent).observed


def test_the_larger_force_of_the_two_is_reported() -> None:
    forces = {2: 14.0, 4: 13.0}
    parts = [[reporting(event, forces) for event in part] for part in FOUR]
    judge(
        "fills_the_result",
        [reporting(event, {"fetch": 14.0}) for event in fetch(1.0, 9.6, SUCCEEDED)],
        *parts,
    )
    last = [reporting(event, {"fetch": 13.0}) for event in fetch(1.0, 9.6, SUCCEEDED)]
    assert "max_grasp_force: 13" in failure("fills_the_result", last, *parts).observed


def reporting(event: Any, forces: dict[Any, float]) -> Any:
    """Return an event whose result, if it has one and its goal is in `forces`, has that force (N)."""
    goal = getattr(event, "goal", "")
    force = forces.get(goal, forces.get(int(goal[5:]) if goal[5:].isdigit() else 0))
    if force is not None and hasattr(event, "result"):
        event = replace(event, result=PickAndPlace.Result(max_grasp_force=force))
    return event


def test_a_child_is_canceled_for_a_reason_only() -> None:
    at_work = [cancel(2.1), child(1, walk(TABLE), 1.2, 3.6, CANCELED)]
    seen = failure("cancel_goes_down", fetch(1.0, 6.0, CANCELED), canceled_fetch(2.5), *at_work)
    assert "to end by itself" in seen.expected


def test_a_cancel_in_the_last_moment_may_come_too_late() -> None:
    judge("fetches", fetch(1.0, 9.6, SUCCEEDED), canceled_fetch(9.45), *FOUR)
