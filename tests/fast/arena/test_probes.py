"""What is recorded of a server's answers, whatever their size and whenever they come."""

from __future__ import annotations

import json
import random
import threading
import uuid
from typing import Any

import pytest

pytest.importorskip("rclpy")

from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from autograder.arena.action_probe import ActionProbe
from autograder.arena.played_service import PlayedService, Reply
from autograder.arena.received import LARGEST, size_of
from autograder.arena.recorder import MOST_OF, MOST_OF_NOBODYS, Recorder
from autograder.arena.service_probe import ServiceProbe
from rclpy.serialization import serialize_message
from rclpy.task import Future
from std_srvs.srv import SetBool, Trigger
from unique_identifier_msgs.msg import UUID

from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.srv import GetJointPositions


class Kept(Recorder):
    """A recorder that keeps its events in a list."""

    def __init__(self) -> None:
        super().__init__(-1)
        self.events: list[dict[str, Any]] = []

    def record(self, kind: str, *, t: float | None = None, **fields: Any) -> None:
        self.events.append({"kind": kind, **fields})

    def of(self, kind: str) -> list[dict[str, Any]]:
        return [event for event in self.events if event["kind"] == kind]


class FakeEndpoint:
    """A client or a service: requests are kept, and a test answers them by setting their futures."""

    def __init__(self) -> None:
        self.futures: list[Future] = []

    def call_async(self, _: Any) -> Future:
        self.futures.append(Future())
        return self.futures[-1]

    def send_response(self, response: Any, header: Any) -> None:
        raise RuntimeError("client will not receive response")


class FakeNode:
    """Makes endpoints of one kind for everything."""

    def __init__(self) -> None:
        self.endpoints: list[FakeEndpoint] = []

    def _create(self, *_: Any, **__: Any) -> FakeEndpoint:
        self.endpoints.append(FakeEndpoint())
        return self.endpoints[-1]

    create_client = create_service = create_subscription = _create


@pytest.fixture
def kept() -> Kept:
    return Kept()


def service_probe(kept: Kept, service_type: Any = Trigger) -> tuple[ServiceProbe, FakeEndpoint]:
    node = FakeNode()
    probe = ServiceProbe(node, service_type, "get_status", kept, threading.Condition())  # type: ignore[arg-type]
    return probe, node.endpoints[0]


def action_probe(kept: Kept) -> tuple[ActionProbe, list[FakeEndpoint]]:
    node = FakeNode()
    probe = ActionProbe(node, node, None, WalkTo, "walk_to", kept, threading.Condition())  # type: ignore[arg-type]
    probe.send_goal("walk", {})
    return probe, node.endpoints


def goal_id(goal: str) -> UUID:
    return UUID(uuid=list(uuid.uuid5(uuid.NAMESPACE_OID, goal).bytes))


def feedback(goal: str, frame: str = "odom") -> bytes:
    message = WalkTo.Impl.FeedbackMessage(goal_id=goal_id(goal))
    message.feedback.current_pose.header.frame_id = frame
    return serialize_message(message)


def statuses(*goals: str) -> bytes:
    listed = [GoalStatus(goal_info=GoalInfo(goal_id=goal_id(goal)), status=2) for goal in goals]
    return serialize_message(GoalStatusArray(status_list=listed))


# -- services ---------------------------------------------------------------------------------------------------------


def test_an_answer_of_readable_size_is_recorded(kept: Kept) -> None:
    probe, client = service_probe(kept)
    probe.send("call 1", {})
    client.futures[0].set_result(Trigger.Response(success=True, message="Motors: ON"))
    assert kept.of("service_answered") == [
        {
            "kind": "service_answered",
            "call": "call 1",
            "response": {"success": True, "message": "Motors: ON"},
        }
    ]


def test_an_answer_that_is_too_large_is_recorded_by_its_size_and_the_scenario_goes_on(kept: Kept) -> None:
    probe, client = service_probe(kept)
    probe.send("call 1", {})
    client.futures[0].set_result(Trigger.Response(message="x" * 12_000_000))
    assert kept.of("service_answered") == []
    (large,) = kept.of("too_large")
    assert (large["what"], large["id"], large["limit"]) == ("answer", "call 1", LARGEST["answer"])
    assert large["bytes"] >= 12_000_000
    assert probe.answers["call 1"] == {"success": False, "message": ""}


def test_an_answer_to_a_call_that_was_given_up_is_nothing(kept: Kept) -> None:
    probe, client = service_probe(kept)
    probe.send("call 1", {})
    client.futures[0].cancel()
    assert kept.of("service_answered") == []
    assert probe.answers == {}


@pytest.mark.parametrize(
    ("fields", "size"),
    [
        ({"message": "x" * 1000}, 1000),
        ({"message": "é" * 1000}, 1000),
        ({"positions": [0.5] * 1000}, 8000),
        ({"names": ["elbow"] * 1000}, 5000),
    ],
)
def test_the_size_of_a_message_is_seen_without_unpacking_it(fields: dict[str, Any], size: int) -> None:
    response = GetJointPositions.Response(message=fields.get("message", ""))
    response.joint_state.position = fields.get("positions", [])
    response.joint_state.name = fields.get("names", [])
    assert size <= size_of(response) <= 3 * size


# -- actions ----------------------------------------------------------------------------------------------------------


def test_feedback_for_nobodys_goals_takes_no_room_from_that_of_real_ones(kept: Kept) -> None:
    probe, _ = action_probe(kept)
    for _ in range(MOST_OF_NOBODYS + 600):
        probe._on_feedback(feedback("nobody's"))
    probe._on_feedback(feedback("walk"))
    kept.finish()
    assert [event["goal"] for event in kept.of("feedback")].count("walk") == 1
    assert [(event["what"], event["count"]) for event in kept.of("dropped")] == [("feedback", 600)]
    assert probe.feedback_counts == {"walk": 1}


def test_feedback_that_is_too_large_is_named_by_its_goal_and_counts_as_come(kept: Kept) -> None:
    probe, _ = action_probe(kept)
    probe._on_feedback(feedback("walk", frame="x" * 60_000))
    (large,) = kept.of("too_large")
    assert (large["what"], large["id"]) == ("feedback", "walk")
    assert kept.of("feedback") == []
    assert probe.feedback_counts["walk"] == 1


@pytest.mark.parametrize("data", [b"", b"\0\1\0\0", feedback("walk")[:40]], ids=["none", "a head", "cut"])
def test_bytes_that_are_no_feedback_are_counted_and_nothing_else(kept: Kept, data: bytes) -> None:
    probe, _ = action_probe(kept)
    probe._on_feedback(data)
    kept.finish()
    assert [(event["what"], event["count"]) for event in kept.of("dropped")] == [("unreadable", 1)]


@pytest.mark.parametrize("seed", range(5))
def test_no_bytes_whatever_stop_the_probe(kept: Kept, seed: int) -> None:
    probe, _ = action_probe(kept)
    chance = random.Random(seed)
    for _ in range(400):
        data = bytearray(chance.choice((feedback("walk"), statuses("walk", "nobody's"))))
        for _ in range(chance.randrange(8)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        cut = bytes(data[: chance.randrange(len(data) + 1)])
        chance.choice((probe._on_feedback, probe._on_status))(cut)
    for event in kept.events:
        json.dumps(event)


def test_a_status_is_recorded_when_it_changes(kept: Kept) -> None:
    probe, _ = action_probe(kept)
    for _ in range(3):
        probe._on_status(statuses("walk"))
    assert [(event["goal"], event["status"]) for event in kept.of("status")] == [("walk", 2)]


def test_of_endless_unknown_goals_not_every_status_is_remembered(kept: Kept) -> None:
    probe, _ = action_probe(kept)
    for start in range(0, MOST_OF_NOBODYS + 500, 500):
        probe._on_status(statuses(*(f"nobody's {number}" for number in range(start, start + 500))))
    probe._on_status(statuses("walk"))
    kept.finish()
    assert len(kept.of("status")) == MOST_OF_NOBODYS + 1
    assert kept.of("status")[-1]["goal"] == "walk"
    assert kept.of("dropped")[0]["count"] == 500


def test_a_result_that_is_too_large_still_ends_the_wait_for_it(kept: Kept) -> None:
    probe, (send_goal, get_result, *_) = action_probe(kept)
    send_goal.futures[0].set_result(WalkTo.Impl.SendGoalService.Response(accepted=True))
    response = WalkTo.Impl.GetResultService.Response(status=4)
    response.result.error_msg = "x" * 70_000_000
    get_result.futures[0].set_result(response)
    assert probe.results == {"walk": 4}
    assert kept.of("result") == []
    assert kept.of("too_large")[0]["what"] == "result"


def test_a_cancel_answered_with_a_hundred_thousand_goals_is_not_unpacked(kept: Kept) -> None:
    probe, (_, _, cancel_goal, *_) = action_probe(kept)
    probe.send_cancel("cancel 1", "walk")
    cancel_goal.futures[0].set_result(CancelGoal.Response(goals_canceling=[GoalInfo()] * 100_000))
    assert kept.of("cancel_answered") == []
    assert kept.of("too_large")[0]["id"] == "cancel 1"


# -- services that the grader plays -----------------------------------------------------------------------------------


def played(kept: Kept) -> tuple[PlayedService, FakeEndpoint]:
    node = FakeNode()
    numbers = iter(range(1, 10**6))
    service = PlayedService(
        node,  # type: ignore[arg-type]
        SetBool,
        "enable_motors",
        [Reply({"success": True})],
        "server 1",
        kept,
        threading.Condition(),
        lambda: f"request {next(numbers)}",
    )
    return service, node.endpoints[0]


def ask(service: PlayedService) -> Any:
    try:
        service._on_request(SetBool.Request(data=True), SetBool.Response()).send(None)
    except StopIteration as answered:
        return answered.value


def test_a_client_that_has_left_before_its_answer_does_no_harm(kept: Kept) -> None:
    _, endpoint = played(kept)
    endpoint.send_response(SetBool.Response(), None)


def test_a_flood_of_requests_is_answered_and_only_counted(kept: Kept) -> None:
    service, _ = played(kept)
    for _ in range(MOST_OF["request_received"] + 70):
        assert ask(service) is not None
    kept.finish()
    assert len(kept.of("request_received")) == MOST_OF["request_received"]
    assert kept.of("dropped")[0]["count"] == 70
