"""The stage of a server: the robot, the student's node, and a client of its services and actions.

A scenario makes its clients, opens the stage, which starts the node, and then calls services, sends goals and commands
the robot. All durations are seconds on the arena's clock. A scenario never judges: if an answer does not come, the
stage records it as unanswered and the scenario goes on, so that a check can say what was missing.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically
from rclpy.node import Node

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.bounded_reading import BoundedReading
from autograder.arena.offering import POLL_PERIOD, Offering
from autograder.arena.phases import Phases
from autograder.arena.robot import Robot, RobotUnavailable
from autograder.arena.simulator import Simulator
from autograder.arena.student import Student
from autograder.arena.topics import RecordedTopic
from ros_runtime.reachability import wait_until_all_reachable
from ros_runtime.recorded_client.action_client import ActionClient
from ros_runtime.recorded_client.conversation import Conversation
from ros_runtime.recorded_client.goal import Goal
from ros_runtime.recorded_client.service_client import ServiceClient

# s, on a clock that still runs at scale 1:
READY_TIMEOUT = 20.0  # for the node to offer the services and actions of the scenario
REMAINING_TIMEOUT = 5.0  # for the remaining ones, once the node offers the first
MATCHING_TIMEOUT = 10.0  # for robot and node to discover each other's topics
REACHING_TIMEOUT = 1.0  # for a first exchange of messages with the node; a faulty node never answers
MOST_REACHED = 4  # nodes with which messages are exchanged
OFFERS_PERIOD = 0.1  # between two queries of all services on offer
CONNECTION_TIME = 0.05  # for the node to discover the clients in turn
# s, on the arena's clock:
CLEAN_EXIT_TIMEOUT = 5.0
__all__ = ["STRANGER", "ActionClient", "Goal", "NodeMissing", "ServiceClient", "Stage"]
STRANGER = "stranger"  # another client of the same actions


class NodeMissing(Exception):
    """The student's endpoints never appeared, so the scenario ends."""


class Parameters:
    """Clients of a node's parameter services: get, set, and set atomically. `Stage.open` creates them.

    `service` is any service of that node, by which it is found.
    """

    get: ServiceClient
    set: ServiceClient
    set_together: ServiceClient

    def __init__(self, service: str) -> None:
        self.service = service


class Stage(Offering):
    """The robot (unless the scenario needs none), the student's node and clients of it."""

    def __init__(
        self,
        node: Node,
        stranger: Node,
        log: ArenaLog,
        simulator: Simulator | None,
        student: Student,
        phases: Phases,
        speed_up: Callable[[], None],
    ) -> None:
        super().__init__(node, log, student, phases, speed_up)
        self._stranger = stranger
        self._robot = Robot(simulator, log) if simulator else None
        self._conversation = Conversation(log, BoundedReading(log), student.has_exited, student.stacks)
        self._services: list[ServiceClient] = []
        self._actions: list[ActionClient] = []
        self._parameters: list[Parameters] = []

    # -- getting ready ------------------------------------------------------------------------------------------------

    def service(self, name: str, service_type: Any) -> ServiceClient:
        """Make a client of one of the student's services."""
        client = ServiceClient(self._node, name, service_type, self._conversation)
        self._services.append(client)
        return client

    def action(self, name: str, action_type: Any) -> ActionClient:
        """Make a client of one of the student's actions, which can also cancel as another node, the STRANGER."""
        others = {STRANGER: self._stranger}
        client = ActionClient(self._node, name, action_type, self._conversation, others)
        self._actions.append(client)
        return client

    def listen(self, topic: str, message_type: Any, *, latched: bool = False, as_: str = "") -> RecordedTopic:
        """Record what the student's node publishes on a topic; `latched`: subscribe with transient local.

        `as_` is the name in the record, by default the topic's; give one to tell two subscriptions of a topic apart.
        """
        return RecordedTopic(self._node, message_type, topic, self._log, latched=latched, as_=as_)

    def parameters_of(self, service: ServiceClient) -> Parameters:
        """Make clients of the parameters of the node that offers a service, whatever its name."""
        self._parameters.append(Parameters(service.name))
        return self._parameters[-1]

    def open(self) -> None:
        """Start the student's node, wait until node, robot and clients have discovered each other, speed up the clock.

        Robot and scenario publish their latched messages before the node starts, as on a real robot: a subscription
        without transient local never receives them.

        Raises:
            NodeMissing: the node does not offer the services and actions in time.
        """
        started = time.monotonic()
        self._student.start()
        self._wait_for_endpoints(started)
        for parameters in self._parameters:
            self._connect(parameters)
            self._wait_for_endpoints(started)
        self._log.append(ev.NodeReady(waited=time.monotonic() - started))
        self._phases.end("discovery")
        self.wait_until(self._robot_and_node_are_connected, MATCHING_TIMEOUT)
        self._reach_node()
        self._report_topics()
        self._graph.inspect()
        self.wait(CONNECTION_TIME)
        self._speed_up()

    # -- the robot and the student's process --------------------------------------------------------------------------

    @property
    def robot(self) -> Robot:
        """The robot; raises if the scenario has none."""
        if self._robot is None:
            raise RobotUnavailable("this scenario has no robot; give its Scenario one (robot=())")
        return self._robot

    def interrupt_node(self) -> None:
        """Send SIGINT, as Ctrl-C does, and wait for the process to end."""
        self._log.append(ev.NodeSignalled(signal="SIGINT"))
        self._student.interrupt()
        self._student.wait(CLEAN_EXIT_TIMEOUT)

    # -- helpers ------------------------------------------------------------------------------------------------------

    def _wait_for_endpoints(self, started: float) -> None:
        """Wait for the student's endpoints; if they do not come, record what is missing."""
        first_offer: float | None = None
        next_look = started
        while missing := self._missing():
            now = time.monotonic()
            if first_offer is None and now >= next_look:
                first_offer = now if self._graph.offered() else None
                next_look = now + OFFERS_PERIOD
            late = now - started > READY_TIMEOUT
            incomplete = first_offer is not None and now - first_offer > REMAINING_TIMEOUT
            if late or incomplete or self._student.has_exited():
                offered = self._graph.offered()
                self._log.append(ev.NodeNotReady(missing=missing, offered=offered, waited=now - started))
                raise NodeMissing
            time.sleep(POLL_PERIOD)

    def _connect(self, parameters: Parameters) -> None:
        """Create the parameter clients for the node that offers the service; without such a node they never match."""
        self.poll_until(lambda: self._graph.owners_of(parameters.service), MATCHING_TIMEOUT)
        owner = next(iter(self._graph.owners_of(parameters.service)), parameters.service)
        parameters.get = self.service(f"{owner}/get_parameters", GetParameters)
        parameters.set = self.service(f"{owner}/set_parameters", SetParameters)
        parameters.set_together = self.service(f"{owner}/set_parameters_atomically", SetParametersAtomically)

    def _missing(self) -> list[str]:
        services = [name for service in self._services for name in service.unmatched()]
        count = self._graph.count_publishers
        return services + [name for action in self._actions for name in action.unmatched(count)]

    def _robot_and_node_are_connected(self) -> bool:
        """Return whether the robot has discovered every subscriber and publisher that its topics can match."""
        if self._robot is None:
            return True
        peers, graph = self._log.last(ev.RobotPeers), self._graph
        return (
            peers is not None
            and bool(peers.subscribers)
            and all(n >= graph.count_matchable_subscribers(topic) for topic, n in peers.subscribers.items())
            and all(count >= graph.count_publishers(topic) for topic, count in peers.publishers.items())
        )

    def close(self) -> None:
        """End the scenario; record the topics again, because the node may have created some meanwhile."""
        self._report_topics()
        super().close()

    def _report_topics(self) -> None:
        if peers := self._log.last(ev.RobotPeers):
            self._graph.report_topics(peers.publishers)

    def _reach_node(self) -> None:
        """Exchange messages with the student's node, so that it has discovered all clients and no answer is lost."""
        services = [service.name for service in self._services]
        services += [f"{action.name}/_action/send_goal" for action in self._actions]
        owners = dict.fromkeys(owner for service in services for owner in self._graph.owners_of(service))
        deadline = time.monotonic() + REACHING_TIMEOUT
        wait_until_all_reachable(self._node, list(owners)[:MOST_REACHED], lambda: time.monotonic() > deadline)
