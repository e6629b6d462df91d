"""How a server's answers are recorded, whatever their size and time of arrival."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from typing import Any

import pytest

pytest.importorskip("rclpy")

from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.serialization import serialize_message
from rclpy.task import Future
from std_srvs.srv import SetBool, Trigger
from unique_identifier_msgs.msg import UUID

from autograder.arena import events as ev
from autograder.arena.arena_log import MOST_OF, MOST_UNMATCHED, ArenaLog
from autograder.arena.bounded_reading import LARGEST, BoundedReading, size_of
from autograder.arena.scripted_service import Reply, ScriptedService
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.srv import GetJointPositions
from ros_runtime.record.event import to_line
from ros_runtime.recorded_client.action_client import ActionClient
from ros_runtime.recorded_client.conversation import Conversation
from ros_runtime.recorded_client.goal import Goal
from ros_runtime.recorded_client.service_client import ServiceClient

UNKNOWN_ID = bytes(15) + b"n"
SOON = 0.01  # s


class FakeEndpoint:
    """A client or a service that stores requests; a test answers them by setting their futures."""

    def __init__(self) -> None:
        self.futures: list[Future] = []
        self.take: Any = None  # the callback of a subscription

    def call_async(self, _: Any) -> Future:
        self.futures.append(Future())
        return self.futures[-1]

    def send_response(self, response: Any, header: Any) -> None:
        raise RuntimeError("client will not receive response")


class FakeNode:
    """A node that makes fake endpoints only."""

    def __init__(self) -> None:
        self.endpoints: list[FakeEndpoint] = []

    def _create(self, *arguments: Any, **_: Any) -> FakeEndpoint:
        self.endpoints.append(FakeEndpoint())
        self.endpoints[-1].take = arguments[2] if len(arguments) > 2 else None
        return self.endpoints[-1]

    create_client = create_service = create_subscription = _create


def service_client(
    log: ArenaLog, stacks: Callable[[], ev.NodeStack | None] = lambda: None
) -> tuple[ServiceClient, FakeEndpoint]:
    node: Any = FakeNode()
    conversation = Conversation(log, BoundedReading(log), server_stacks=stacks)
    client = ServiceClient(node, "get_status", Trigger, conversation)
    return client, node.endpoints[0]


class Walking:
    """A client of walk_to that has sent one goal, and the fake endpoints of the action."""

    def __init__(self, log: ArenaLog) -> None:
        node: Any = FakeNode()
        client = ActionClient(node, "walk_to", WalkTo, Conversation(log, BoundedReading(log)))
        self.send_goal, self.get_result, self.cancel_goal, feedback, status = node.endpoints
        self.goal: Goal = client.send(as_="walk")
        self.on_feedback, self.on_status = feedback.take, status.take

    def feedback(self, frame: str = "odom", goal_id: bytes = b"") -> bytes:
        message = WalkTo.Impl.FeedbackMessage(goal_id=UUID(uuid=list(goal_id or self.goal.id)))
        message.feedback.current_pose.header.frame_id = frame
        return serialize_message(message)

    def statuses(self, *goal_ids: bytes) -> bytes:
        infos = [GoalInfo(goal_id=UUID(uuid=list(goal_id))) for goal_id in goal_ids or (self.goal.id,)]
        listed = [GoalStatus(goal_info=info, status=2) for info in infos]
        return serialize_message(GoalStatusArray(status_list=listed))


def dropped(log: ArenaLog) -> list[tuple[str, int]]:
    log.finish()
    return [(event.what, event.count) for event in log.all(ev.RecordDropped)]


# -- services ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("is_answered", [False, True])
def test_the_stacks_of_a_late_server_are_read_before_the_timeout_and_kept_if_no_answer_comes(
    log: ArenaLog, is_answered: bool
) -> None:
    unanswered: list[int] = []

    def stacks() -> ev.NodeStack:
        unanswered.append(log.count(ev.Unanswered))
        if is_answered:
            endpoint.futures[0].set_result(Trigger.Response())
        return ev.NodeStack(lines=["asleep"])

    client, endpoint = service_client(log, stacks)
    assert client.call(timeout=SOON) == is_answered
    assert unanswered == [0]
    assert log.count(ev.NodeStack) == (not is_answered)


def test_an_answer_of_readable_size_is_recorded(log: ArenaLog) -> None:
    client, end = service_client(log)
    call = client.send(as_="first")
    response = Trigger.Response(success=True, message="Motors: ON")
    end.futures[0].set_result(response)
    assert [(event.call, event.response) for event in log.all(ev.ServiceAnswered)] == [("first", response)]
    assert call.wait(SOON)
    assert call.response == response


def test_an_answer_that_is_too_large_is_recorded_by_its_size_and_the_scenario_goes_on(log: ArenaLog) -> None:
    client, end = service_client(log)
    call = client.send(as_="first")
    end.futures[0].set_result(Trigger.Response(message="x" * 12_000_000))
    assert log.all(ev.ServiceAnswered) == []
    (large,) = log.all(ev.TooLarge)
    assert (large.what, large.id, large.limit) == ("answer", "first", LARGEST["answer"])
    assert large.bytes >= 12_000_000
    assert call.wait(SOON)
    assert call.response is None
    assert log.all(ev.Unanswered) == []


def test_an_answer_to_an_abandoned_call_is_ignored(log: ArenaLog) -> None:
    client, end = service_client(log)
    call = client.send()
    end.futures[0].cancel()
    assert log.all(ev.ServiceAnswered) == []
    assert not call.wait(SOON)
    assert [(event.what, event.id) for event in log.all(ev.Unanswered)] == [("call", "get_status 1")]


def test_calls_have_given_or_numbered_names_which_are_unique(log: ArenaLog) -> None:
    client, _ = service_client(log)
    assert [client.send(as_=name).name for name in ("", "mine", "")] == [
        "get_status 1",
        "mine",
        "get_status 2",
    ]
    with pytest.raises(ValueError, match="already a call named 'mine'"):
        client.send(as_="mine")


@pytest.mark.parametrize(
    ("fields", "size"),
    [
        ({"message": "x" * 1000}, 1000),
        ({"message": "é" * 1000}, 1000),
        ({"positions": [0.5] * 1000}, 8000),
        ({"names": ["elbow"] * 1000}, 5000),
    ],
)
def test_the_size_of_a_message_is_known_without_deserializing_it(fields: dict[str, Any], size: int) -> None:
    response = GetJointPositions.Response(message=fields.get("message", ""))
    response.joint_state.position = fields.get("positions", [])
    response.joint_state.name = fields.get("names", [])
    assert size <= size_of(response) <= 3 * size


# -- actions ----------------------------------------------------------------------------------------------------------


def test_feedback_for_unknown_goals_does_not_displace_feedback_of_known_goals(log: ArenaLog) -> None:
    walking = Walking(log)
    for _ in range(MOST_UNMATCHED + 600):
        walking.on_feedback(walking.feedback(goal_id=UNKNOWN_ID))
    walking.on_feedback(walking.feedback())
    assert log.count(ev.FeedbackReceived, goal="walk") == len(walking.goal.feedback) == 1
    assert dropped(log) == [(ev.FeedbackReceived.kind, 600)]


def test_too_large_feedback_is_recorded_with_its_goal_and_counts_as_received(log: ArenaLog) -> None:
    walking = Walking(log)
    walking.on_feedback(walking.feedback(frame="x" * 60_000))
    (large,) = log.all(ev.TooLarge)
    assert (large.what, large.id) == ("feedback", "walk")
    assert log.all(ev.FeedbackReceived) == []
    assert walking.goal.wait_for_feedback(1, SOON)


@pytest.mark.parametrize("size", [0, 4, 40])
def test_bytes_that_are_not_feedback_are_only_counted(log: ArenaLog, size: int) -> None:
    walking = Walking(log)
    walking.on_feedback(walking.feedback()[:size])
    assert dropped(log) == [("unreadable", 1)]


@pytest.mark.parametrize("seed", range(5))
def test_arbitrary_bytes_do_not_stop_the_client(log: ArenaLog, seed: int) -> None:
    walking = Walking(log)
    chance = random.Random(seed)
    for _ in range(400):
        data = bytearray(chance.choice((walking.feedback(), walking.statuses(walking.goal.id, UNKNOWN_ID))))
        for _ in range(chance.randrange(8)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        cut = bytes(data[: chance.randrange(len(data) + 1)])
        chance.choice((walking.on_feedback, walking.on_status))(cut)
    for event in (*log.all(ev.FeedbackReceived), *log.all(ev.StatusSeen), *log.all(ev.TooLarge)):
        json.loads(to_line(event))


def test_a_status_is_recorded_when_it_changes(log: ArenaLog) -> None:
    walking = Walking(log)
    for _ in range(3):
        walking.on_status(walking.statuses())
    assert [(event.goal, event.status) for event in log.all(ev.StatusSeen)] == [("walk", 2)]


def test_the_number_of_stored_statuses_of_unknown_goals_is_limited(log: ArenaLog) -> None:
    walking = Walking(log)
    for start in range(0, MOST_UNMATCHED + 500, 500):
        walking.on_status(
            walking.statuses(*(number.to_bytes(16, "little") for number in range(start + 1, start + 501)))
        )
    walking.on_status(walking.statuses())
    seen = log.all(ev.StatusSeen)
    assert len(seen) == MOST_UNMATCHED + 1
    assert seen[-1].goal == "walk"
    assert dropped(log) == [(ev.StatusSeen.kind, 500)]


def test_a_result_that_is_too_large_still_ends_the_wait_for_it(log: ArenaLog) -> None:
    walking = Walking(log)
    walking.send_goal.futures[0].set_result(WalkTo.Impl.SendGoalService.Response(accepted=True))
    response = WalkTo.Impl.GetResultService.Response(status=4)
    response.result.error_msg = "x" * 70_000_000
    walking.get_result.futures[0].set_result(response)
    assert walking.goal.wait_for_result(SOON)
    assert log.all(ev.ResultReceived) == []
    assert log.all(ev.TooLarge)[0].what == "result"


def test_a_goal_has_its_answer_its_feedback_and_its_result(log: ArenaLog) -> None:
    walking = Walking(log)
    assert walking.goal.accepted is None
    walking.send_goal.futures[0].set_result(WalkTo.Impl.SendGoalService.Response(accepted=True))
    walking.on_feedback(walking.feedback())
    walking.get_result.futures[0].set_result(WalkTo.Impl.GetResultService.Response(status=4))
    assert (walking.goal.accepted, len(walking.goal.feedback), walking.goal.has_ended) == (True, 1, True)
    assert walking.goal.result is not None
    assert walking.goal.result.status == 4


def test_a_goal_that_is_rejected_has_no_result_to_wait_for(log: ArenaLog) -> None:
    walking = Walking(log)
    walking.send_goal.futures[0].set_result(WalkTo.Impl.SendGoalService.Response(accepted=False))
    assert not walking.goal.wait_for_result()
    assert walking.get_result.futures == []


def test_a_cancel_answered_with_a_hundred_thousand_goals_is_not_unpacked(log: ArenaLog) -> None:
    walking = Walking(log)
    cancel = walking.goal.cancel()
    walking.cancel_goal.futures[0].set_result(CancelGoal.Response(goals_canceling=[GoalInfo()] * 100_000))
    assert cancel.wait(SOON)
    assert cancel.answer is None
    assert log.all(ev.TooLarge)[0].id == "cancel 1"


# -- scripted services ------------------------------------------------------------------------------------------------


def scripted(log: ArenaLog) -> tuple[ScriptedService, FakeEndpoint]:
    node: Any = FakeNode()
    numbers = iter(range(1, 10**6))
    service = ScriptedService(
        node,
        SetBool,
        "enable_motors",
        [Reply(SetBool.Response(success=True))],
        "server 1",
        log,
        lambda: f"request {next(numbers)}",
    )
    return service, node.endpoints[0]


def ask(service: ScriptedService) -> Any:
    try:
        service._on_request(SetBool.Request(data=True), SetBool.Response()).send(None)
    except StopIteration as answered:
        return answered.value


def test_a_client_that_ends_before_its_answer_does_no_harm(log: ArenaLog) -> None:
    _, endpoint = scripted(log)
    endpoint.send_response(SetBool.Response(), None)


def test_a_flood_of_requests_is_answered_and_only_counted(log: ArenaLog) -> None:
    service, _ = scripted(log)
    most = MOST_OF[ev.RequestReceived.kind]
    for _ in range(most + 70):
        assert ask(service) is not None
    assert service.requests == most
    assert dropped(log) == [(ev.RequestReceived.kind, 70)]
