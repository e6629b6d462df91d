"""What every stage can do: wait on the arena's clock, and offer scripted services, actions and topics."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable
from itertools import count
from typing import Any

from rclpy.node import Node

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.graph import Graph
from autograder.arena.phases import Phases
from autograder.arena.scripted_action import GoalScript, ScriptedAction
from autograder.arena.scripted_service import Reply, ScriptedService
from autograder.arena.student import Student
from autograder.arena.topics import ScriptedTopic
from autograder.arena.units import Seconds

FLOOD = 50  # messages within QUIET_TIME; no correct node sends so many
QUIET_TIME = 0.25  # s on the arena's clock
FLOOD_TIMEOUT = 15.0  # s on the arena's clock to wait for the end of a flood
POLL_PERIOD = 0.005  # s between two polls of a state without notification, such as the graph


class Offering:
    """Waits for time or events, and offers what the student's node needs; times are s on the arena's clock."""

    def __init__(
        self, node: Node, log: ArenaLog, student: Student, phases: Phases, speed_up: Callable[[], None]
    ) -> None:
        self._node = node
        self._log = log
        self._graph = Graph(node, log)
        self._student = student
        self._phases = phases
        self._speed_up = speed_up
        self._offered_services: list[ScriptedService] = []
        self._offered_actions: list[ScriptedAction] = []
        self._offered_topics: list[ScriptedTopic] = []
        self._numbers: defaultdict[str, count[int]] = defaultdict(lambda: count(1))

    # -- waiting ------------------------------------------------------------------------------------------------------

    def wait(self, duration: Seconds) -> None:
        """Let time pass."""
        deadline = time.monotonic() + duration
        while (left := deadline - time.monotonic()) > 0:
            time.sleep(left)

    def wait_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        """Wait for a condition on the log; return False if the time is over first."""
        return self._log.wait_until(condition, timeout)

    def poll_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        """Poll a condition that is not about the log; return False if the time is over first."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                return False
            time.sleep(POLL_PERIOD)
        return True

    def close(self) -> None:
        """End the scenario: record the messages still in transit, and which limits were exceeded."""
        self._drain_messages()
        self._graph.inspect()
        self._log.finish()

    def _drain_messages(self) -> None:
        """Wait until a flood of messages is processed: evidence against the node may be queued behind it."""
        deadline = time.monotonic() + FLOOD_TIMEOUT
        before = self._log.received
        while True:
            self.wait(QUIET_TIME)
            now = self._log.received
            if now - before < FLOOD:
                return
            if time.monotonic() > deadline:
                self._log.drop("unread")
                return
            before = now

    def mark(self, name: str) -> None:
        """Name this moment for the checks."""
        self._log.append(ev.Mark(name=name))

    def plan(self, steps: list[str]) -> None:
        """Record the steps that follow, in words, for the failures of checks."""
        self._log.append(ev.StepsPlanned(words=steps))

    # -- offering -----------------------------------------------------------------------------------------------------

    def offer_service(self, name: str, service_type: Any, *replies: Reply | None) -> ScriptedService:
        """Offer a service that answers request n with `replies[n]`, later requests with the last one."""
        service = ScriptedService(
            self._node,
            service_type,
            name,
            replies,
            self._number("server"),
            self._log,
            lambda: self._number("request"),
        )
        self._offered_services.append(service)
        return service

    def offer_action(self, name: str, action_type: Any, *scripts: GoalScript) -> ScriptedAction:
        """Offer an action that treats goal n by `scripts[n]`, later goals by the last one."""
        action = ScriptedAction(
            self._node, action_type, name, scripts, self._number("server"), self._log, self._number
        )
        self._offered_actions.append(action)
        return action

    def offer_topic(self, name: str, message_type: Any, *, latched: bool = False) -> ScriptedTopic:
        """Publish a topic, with durability transient local when it is `latched`."""
        topic = ScriptedTopic(self._node, message_type, name, self._log, latched=latched)
        self._offered_topics.append(topic)
        return topic

    def wait_for_requests(self, service: ScriptedService, number: int, timeout: float) -> bool:
        """Wait for `number` requests to a scripted service; return False on timeout or at the program's end."""
        self.wait_until(lambda: service.requests >= number or self._student.has_exited(), timeout)
        return service.requests >= number

    def _offers_anything(self) -> bool:
        return bool(self._offered_services or self._offered_actions or self._offered_topics)

    def _was_asked(self) -> bool:
        """Return whether any request or goal was received."""
        services, actions = self._offered_services, self._offered_actions
        return any(service.requests for service in services) or any(action.goals for action in actions)

    def _is_known(self) -> bool:
        """Return whether every scripted service and action has a client, and every topic a subscription."""
        asked = [service.name for service in self._offered_services]
        asked += [f"{action.name}/_action/send_goal" for action in self._offered_actions]
        return all(map(self._graph.count_clients, asked)) and all(
            topic.subscriptions for topic in self._offered_topics
        )

    def _number(self, what: str) -> str:
        return f"{what} {next(self._numbers[what])}"
