"""Converts the goals and messages of a run to messages on the topics that a real robot would have.

An action's feedback and status are on its hidden topics `_action/feedback` and `_action/status`. Its goals and results
are service events (ROS 2's service introspection) of `_action/send_goal` and `_action/get_result`. The transcript gives
each goal a name; UUIDs and sequence numbers are derived from the names, so they are the same in every recording.
Service calls and cancel requests are recorded as text only (`narration`), because rosbags, with which the tests read
recordings, has no service types.
"""

from __future__ import annotations

import uuid
from collections.abc import Iterator
from typing import Any

from action_msgs.msg import GoalInfo, GoalStatusArray
from action_msgs.msg import GoalStatus as GoalStatusMessage
from service_msgs.msg import ServiceEventInfo
from unique_identifier_msgs.msg import UUID

from autograder.authoring.evidence import events as ev
from autograder.recording.definitions import class_of
from autograder.recording.entry import Entry, full_name, stamp
from ros_runtime.message_constants import GoalStatus
from ros_runtime.messages import is_message, type_name

_REQUEST_SENT, _REQUEST_RECEIVED = ServiceEventInfo.REQUEST_SENT, ServiceEventInfo.REQUEST_RECEIVED
_RESPONSE_SENT, _RESPONSE_RECEIVED = ServiceEventInfo.RESPONSE_SENT, ServiceEventInfo.RESPONSE_RECEIVED
_UUIDS = uuid.UUID("5e1f0c5e-1d0e-4c0a-9d61-0d5d2f2c7a10")  # UUID namespace of the course
_MAX_LISTED_GOALS = 100  # goals in one status message


class InterfaceMessages:
    """Converts the events of one run to messages; call `of` with all events in order.

    An inconsistent event (a response without a request, a message of another type) yields nothing.
    """

    def __init__(self, namespace: str) -> None:
        self._namespace = namespace
        self._actions: dict[str, tuple[str, str]] = {}  # action and its type, by goal
        self._statuses: dict[str, dict[str, int]] = {}  # statuses of the goals, by action and goal
        self._accepted: dict[str, float] = {}
        self._results: dict[str, tuple[int, Any]] = {}
        self._numbers: dict[str, int] = {}

    def of(self, event: Any) -> Iterator[Entry]:
        """Yield the messages of one event."""
        match event:
            case ev.GoalSent(goal=goal, action=action, request=message):
                yield from self._goal(event.t, goal, action, message, _REQUEST_SENT)
            case ev.GoalReceived(goal=goal, action=action, message=message):
                yield from self._goal(event.t, goal, action, message, _REQUEST_RECEIVED)
            case ev.GoalAnswered(goal=goal, accepted=accepted):
                yield from self._goal_reply(event.t, goal, accepted, _RESPONSE_RECEIVED)
            case ev.GoalReplySent(goal=goal, accepted=accepted):
                yield from self._goal_reply(event.t, goal, accepted, _RESPONSE_SENT)
                if accepted:
                    yield from self._status(event.t, goal, GoalStatus.EXECUTING)
            case (
                ev.FeedbackReceived(goal=goal, feedback=feedback)
                | ev.FeedbackSent(goal=goal, feedback=feedback)
            ):
                yield from self._feedback(event.t, goal, feedback)
            case ev.StatusSeen(goal=goal, status=status):
                yield from self._status(event.t, goal, status)
            case ev.CancelReplySent(canceling=goals):
                for goal in goals:
                    yield from self._status(event.t, goal, GoalStatus.CANCELING)
            case ev.ResultReceived(goal=goal, status=status, result=result):
                yield from self._result(event.t, goal, status, result, _RESPONSE_RECEIVED)
            case ev.GoalFinished(goal=goal, status=status, result=result):
                self._results[goal] = (status, result)
                yield from self._status(event.t, goal, status)
            case ev.ResultSent(goal=goal) if goal in self._results:
                yield from self._result(event.t, goal, *self._results[goal], _RESPONSE_SENT)
            case (
                ev.MessageReceived(topic=topic, message=message)
                | ev.MessagePublished(topic=topic, message=message)
            ) if is_message(message):
                yield Entry(event.t, full_name(self._namespace, topic), message)

    def _goal(self, t: float, goal: str, action: str, message: Any, kind: int) -> Iterator[Entry]:
        base = _base_of(message, "_Goal")
        if base:
            self._actions[goal] = (action, base)
            request = class_of(f"{base}_SendGoal_Request")(goal_id=_uuid(goal), goal=message)
            yield self._part(t, goal, "send_goal", f"{base}_SendGoal_Event", kind, request=request)

    def _goal_reply(self, t: float, goal: str, accepted: bool, kind: int) -> Iterator[Entry]:
        if goal in self._actions:
            base = self._actions[goal][1]
            self._accepted.setdefault(goal, t)
            response = class_of(f"{base}_SendGoal_Response")(accepted=bool(accepted), stamp=stamp(t))
            yield self._part(t, goal, "send_goal", f"{base}_SendGoal_Event", kind, response=response)

    def _result(self, t: float, goal: str, status: int, result: Any, kind: int) -> Iterator[Entry]:
        base = self._actions.get(goal, ("", ""))[1]
        if base and _base_of(result, "_Result") == base and -128 <= status < 128:
            response = class_of(f"{base}_GetResult_Response")(status=status, result=result)
            yield self._part(t, goal, "get_result", f"{base}_GetResult_Event", kind, response=response)

    def _part(self, t: float, goal: str, part: str, event_type: str, kind: int, **parts: Any) -> Entry:
        """Return a service event of `part`, which is one of the action's services."""
        message = class_of(event_type)()
        message.info.event_type = kind
        message.info.stamp = stamp(t)
        message.info.sequence_number = self._numbers.setdefault(goal, len(self._numbers) + 1)
        for name, value in parts.items():
            setattr(message, name, [value])
        action = full_name(self._namespace, self._actions[goal][0])
        return Entry(t, f"{action}/_action/{part}/_service_event", message)

    def _feedback(self, t: float, goal: str, feedback: Any) -> Iterator[Entry]:
        action, base = self._actions.get(goal, ("", ""))
        if base and _base_of(feedback, "_Feedback") == base:
            message = class_of(f"{base}_FeedbackMessage")(goal_id=_uuid(goal), feedback=feedback)
            yield Entry(t, f"{full_name(self._namespace, action)}/_action/feedback", message)

    def _status(self, t: float, goal: str, status: int) -> Iterator[Entry]:
        if goal not in self._actions or not -128 <= status < 128:
            return
        action = self._actions[goal][0]
        goals = self._statuses.setdefault(action, {})
        goals[goal] = int(status)
        listed = [
            GoalStatusMessage(goal_info=self._info(each), status=goals[each])
            for each in list(goals)[-_MAX_LISTED_GOALS:]
        ]
        topic = f"{full_name(self._namespace, action)}/_action/status"
        yield Entry(t, topic, GoalStatusArray(status_list=listed))

    def _info(self, goal: str) -> GoalInfo:
        return GoalInfo(goal_id=_uuid(goal), stamp=stamp(self._accepted.get(goal, 0.0)))


def _uuid(goal: str) -> UUID:
    return UUID(uuid=list(uuid.uuid5(_UUIDS, goal.encode("utf-8", "replace").decode()).bytes))


def _base_of(message: Any, part: str) -> str:
    """Return the interface whose part a message is, such as 'std_srvs/srv/Trigger'; "" for any other message."""
    name = type_name(message) if is_message(message) else ""
    return name.removesuffix(part) if name.endswith(part) else ""
