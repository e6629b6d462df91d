"""The verbs a scenario is written in. Each blocks until it is done or its time is over, and records what happened.

All durations are seconds on the arena's clock. A scenario never judges: when an answer does not come, that is
recorded as unanswered and the scenario goes on, so that a check can say what was missing.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.node import Node

from autograder.arena.action_probe import ActionProbe
from autograder.arena.graph import Graph
from autograder.arena.phases import Phases
from autograder.arena.recorder import Recorder
from autograder.arena.service_probe import ServiceProbe
from autograder.arena.simulator import Simulator
from autograder.arena.student import Student
from autograder.arena.waiting import POLLING, Waiting
from ros_runtime.reachability import wait_until_all_reachable

# s, on a clock that still runs at scale 1:
READY_TIMEOUT = 20.0  # for the node to offer what is asked for
COMPANY_TIMEOUT = 5.0  # for the rest of it, once the node offers anything
MATCHING_TIMEOUT = 10.0  # for robot and node to find each other's topics
GREETING_TIMEOUT = 1.0  # a sound node may be slow to answer anything yet, a faulty one never does
MOST_GREETED = 4  # nodes
LOOKING = 0.1  # between two looks at all that is offered
SETTLING = 0.05  # for the node's own side of those connections
# s, on the arena's clock:
CALL_TIMEOUT = 5.0
GOAL_TIMEOUT = 5.0
CANCEL_TIMEOUT = 5.0
RESULT_TIMEOUT = 40.0
CLEAN_EXIT_TIMEOUT = 5.0
ROBOT_TIMEOUT = 30.0


class NodeMissing(Exception):
    """The student's endpoints never appeared; there is nothing left for the scenario to do."""


class RobotTrouble(Exception):
    """The simulator did not do what the scenario needs: our fault, never the student's."""


class Stage(Waiting):
    """The robot (unless the scenario needs none), the student's node and a client for it."""

    def __init__(
        self,
        node: Node,
        stranger: Node,
        recorder: Recorder,
        changed: threading.Condition,
        simulator: Simulator | None,
        student: Student,
        phases: Phases,
        speed_up: Callable[[], None],
    ) -> None:
        super().__init__(Graph(node, recorder), recorder, changed)
        self._node = node
        self._stranger = stranger
        self._robot = simulator
        self._student = student
        self._phases = phases
        self._speed_up = speed_up
        self._services: dict[str, ServiceProbe] = {}
        self._actions: dict[str, ActionProbe] = {}
        self._count = 0

    # -- getting ready ------------------------------------------------------------------------------------------------

    def open(
        self,
        services: Mapping[str, Any] | None = None,
        actions: Mapping[str, Any] | None = None,
        *,
        parameters_of: str = "",
    ) -> None:
        """Connect to the student's services and actions (name → type) and wait until they and the robot are there.

        `parameters_of` names one of the services: get_parameters and set_parameters of the node that offers it,
        whatever that is called, can then be called too. The clock is sped up from here on. Raises
        :class:`NodeMissing` when the endpoints do not come.
        """
        for name, service_type in (services or {}).items():
            self._services[name] = ServiceProbe(self._node, service_type, name, self._recorder, self._changed)
        for name, action_type in (actions or {}).items():
            self._actions[name] = ActionProbe(
                self._node, self._stranger, self._graph, action_type, name, self._recorder, self._changed
            )
        started = time.monotonic()
        if not self.wait_until(self._robot_is_there, ROBOT_TIMEOUT):
            raise RobotTrouble(f"the simulator was not ready within {ROBOT_TIMEOUT:g} s")
        self._wait_for_endpoints(started)
        if parameters_of:
            self._open_parameters(parameters_of)
            self._wait_for_endpoints(started)
        self._recorder.record("node_ready", waited=time.monotonic() - started)
        self._phases.end("discovery")
        self.wait_until(self._robot_and_node_are_connected, MATCHING_TIMEOUT)
        self._greet_node()
        self._graph.inspect()
        self.wait(SETTLING)
        self._speed_up()

    # -- services -----------------------------------------------------------------------------------------------------

    def call(
        self, service: str, request: dict[str, Any] | None = None, *, timeout: float = CALL_TIMEOUT
    ) -> str:
        """Call a service and wait for the answer; returns the call's name ('call 1', 'call 2', …)."""
        call = self.send_call(service, request)
        self.wait_for_answer(service, call, timeout)
        return call

    def send_call(self, service: str, request: dict[str, Any] | None = None) -> str:
        """Call a service without waiting."""
        call = self._name("call")
        self._services[service].send(call, request or {})
        return call

    def wait_for_answer(self, service: str, call: str, timeout: float = CALL_TIMEOUT) -> bool:
        """Wait for the answer to a call sent before."""
        return self._wait_for_reply("call", call, lambda: call in self._services[service].answers, timeout)

    def response(self, service: str, call: str) -> dict[str, Any] | None:
        """Return the response to a call; None if it has not come."""
        return self._services[service].answers.get(call)

    # -- actions ------------------------------------------------------------------------------------------------------

    def send_goal(self, action: str, goal: str, request: dict[str, Any], *, wait: bool = True) -> bool:
        """Send a goal under a name of your own; waits for yes or no unless told not to.

        Returns whether it was accepted.
        """
        probe = self._actions[action]
        probe.send_goal(goal, request)
        if wait:
            self.wait_for_goal_answer(action, goal)
        return probe.answers.get(goal, False)

    def wait_for_goal_answer(self, action: str, goal: str) -> bool:
        """Wait for the server's yes or no."""
        return self._wait_for_reply("goal", goal, lambda: goal in self._actions[action].answers, GOAL_TIMEOUT)

    def wait_for_feedback(
        self, action: str, goal: str, count: int = 1, timeout: float = RESULT_TIMEOUT
    ) -> bool:
        """Wait until `count` feedback messages of a goal have come, or its result."""
        probe = self._actions[action]
        return self.wait_until(
            lambda: (
                probe.feedback_counts[goal] >= count or goal in probe.results or self._student.has_exited()
            ),
            timeout,
        )

    def wait_for_result(self, action: str, goal: str, timeout: float = RESULT_TIMEOUT) -> bool:
        """Wait for the result of an accepted goal; returns at once for one that was not accepted."""
        probe = self._actions[action]
        if not probe.answers.get(goal, False):
            return False
        return self._wait_for_reply("result", goal, lambda: goal in probe.results, timeout)

    def cancel(self, action: str, goal: str = "", *, by: str = "client", wait: bool = True) -> str:
        """Ask to cancel a goal (none named: every goal); returns the request's name ('cancel 1', …)."""
        cancel = self._name("cancel")
        self._actions[action].send_cancel(cancel, goal, by)
        if wait:
            self.wait_for_cancel_answer(action, cancel)
        return cancel

    def wait_for_cancel_answer(self, action: str, cancel: str) -> bool:
        """Wait for the answer to a cancel request."""
        answers = self._actions[action].cancel_answers
        return self._wait_for_reply("cancel", cancel, lambda: cancel in answers, CANCEL_TIMEOUT)

    def cancel_code(self, action: str, cancel: str) -> int | None:
        """Return the return code of an answered cancel request."""
        return self._actions[action].cancel_answers.get(cancel)

    # -- the robot ----------------------------------------------------------------------------------------------------

    @property
    def robot(self) -> dict[str, Any]:
        """The latest truth about the robot (fields of :class:`autograder.authoring.events.RobotTruth`)."""
        robot = self._simulator.robot
        if robot is None:
            raise RobotTrouble("the simulator has said nothing yet")
        return robot

    def command_robot(self, do: str, **arguments: Any) -> None:
        """Push the robot, set its battery, cut its motors…: the commands of :mod:`robot_sim.ros.scenario_control`."""
        self._simulator.command(do, **arguments)

    def wait_for_commands(self) -> bool:
        """Wait until every command has taken effect, and what it asked for has been reported."""
        robot = self._simulator
        return self.wait_until(lambda: robot.has_obeyed() or not robot.is_running(), ROBOT_TIMEOUT)

    def wait_for_published(self, kind: str, number: int) -> bool:
        """Wait until every command has taken effect, and then for `number` messages ('battery', 'joints') more."""
        self.wait_for_commands()
        robot = self._simulator
        enough = robot.reports[kind] + number
        return self.wait_until(lambda: robot.reports[kind] >= enough or not robot.is_running(), ROBOT_TIMEOUT)

    def wait_for_robot(
        self, condition: Callable[[dict[str, Any]], bool], timeout: float = ROBOT_TIMEOUT
    ) -> bool:
        """Wait for a condition on the truth about the robot."""
        return self.wait_until(lambda: condition(self.robot) or not self._simulator.is_running(), timeout)

    # -- the student's process ----------------------------------------------------------------------------------------

    def interrupt_node(self) -> None:
        """Send SIGINT, as Ctrl-C does, and wait for the process to end."""
        self._recorder.record("node_signalled", signal="SIGINT")
        self._student.interrupt()
        self._student.wait(CLEAN_EXIT_TIMEOUT)

    # -- helpers ------------------------------------------------------------------------------------------------------

    @property
    def _simulator(self) -> Simulator:
        if self._robot is None:
            raise RobotTrouble("this scenario has no robot; give its Scenario one (robot=())")
        return self._robot

    def _robot_is_there(self) -> bool:
        return self._robot is None or self._robot.robot is not None

    def _wait_for_endpoints(self, started: float) -> None:
        """Return when the student's endpoints are there; record what is missing when they do not come."""
        first_offer: float | None = None
        next_look = started
        while missing := self._missing():
            now = time.monotonic()
            if first_offer is None and now >= next_look:
                first_offer = now if self._graph.offered() else None
                next_look = now + LOOKING
            late = now - started > READY_TIMEOUT
            incomplete = first_offer is not None and now - first_offer > COMPANY_TIMEOUT
            if late or incomplete or self._student.has_exited():
                self._recorder.record(
                    "node_not_ready", missing=missing, offered=self._graph.offered(), waited=now - started
                )
                raise NodeMissing
            time.sleep(POLLING)

    def _open_parameters(self, service: str) -> None:
        """Connect to the parameters of the node that offers a service; without one, to what never comes."""
        self.poll_until(lambda: self._graph.owners_of(service), MATCHING_TIMEOUT)
        owner = next(iter(self._graph.owners_of(service)), service)
        for name, service_type in (("get_parameters", GetParameters), ("set_parameters", SetParameters)):
            self._services[name] = ServiceProbe(
                self._node, service_type, f"{owner}/{name}", self._recorder, self._changed
            )

    def _missing(self) -> list[str]:
        probes: list[ServiceProbe | ActionProbe] = [*self._services.values(), *self._actions.values()]
        return [name for probe in probes for name in probe.missing()]

    def _robot_and_node_are_connected(self) -> bool:
        """Whether the robot has found every subscriber and publisher of its topics that it can be matched with."""
        robot, graph = self._robot, self._graph
        return robot is None or (
            bool(robot.subscribers)
            and all(n >= graph.count_matchable_subscribers(topic) for topic, n in robot.subscribers.items())
            and all(count >= graph.count_publishers(topic) for topic, count in robot.publishers.items())
        )

    def _greet_node(self) -> None:
        """Exchange messages with the student's node, so that its answers are not lost on a client it does not know."""
        services = [*self._services, *(f"{action}/_action/send_goal" for action in self._actions)]
        owners = dict.fromkeys(owner for service in services for owner in self._graph.owners_of(service))
        deadline = time.monotonic() + GREETING_TIMEOUT
        wait_until_all_reachable(self._node, list(owners)[:MOST_GREETED], lambda: time.monotonic() > deadline)

    def _wait_for_reply(self, what: str, name: str, has_come: Callable[[], bool], timeout: float) -> bool:
        """Wait for a reply; record that it is missing when the time is over or the student's process has ended."""
        started = time.monotonic()
        self.wait_until(lambda: has_come() or self._student.has_exited(), timeout)
        if has_come():
            return True
        self._recorder.record("unanswered", what=what, id=name, waited=time.monotonic() - started)
        return False

    def _name(self, kind: str) -> str:
        self._count += 1
        return f"{kind} {self._count}"
