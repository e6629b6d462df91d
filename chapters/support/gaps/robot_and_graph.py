"""Chapter 1: robot and graph."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from std_srvs.srv import SetBool

from lab.client.connection import NAMESPACE
from lab.client.graph import topics_in_graph
from lab.client.services import call
from lab.client.topics import mode, pose
from lab.client.waiting import comes_true
from lab.errors import NodeEndedError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error_or_line
from lab.running.robot import restart_robot, robot_process
from lab.running.student_nodes import StudentNode, run_node

TOPICS = {"odom", "robot_state", "battery_state", "joint_states", "imu"}
PAUSE_SERVICE = "/sim/set_pause"
ACCEPTED_DISTANCES = (0.9, 1.5)  # m; the robot finishes its step after the last command
NO_ERROR_HINT = "fix the error that is named here"


def receives_five_topics() -> str:
    """Look which topics arrive with the student's QoS profiles."""
    node = _start(
        "monitor_fixed.py",
        {
            "NoneType": "end each path of qos with `return` and a profile",
            "depth settings are required": "give the profile a depth: QoSProfile(depth=10, …)",
        },
    )
    comes_true(lambda: "received:" in node.log() or not node.is_running, 10.0)
    _require_running(node, {})
    received = _received_topics(node.log())
    silent = ", ".join(sorted(TOPICS - received))
    expect(
        received == TOPICS,
        seen=f"nothing arrived on {silent}. {_mismatches(node)}",
        expected="messages on all five topics",
        next="for these topics request no more than the publisher offers",
    )
    return f"messages arrived on {', '.join(sorted(received))}"


def knows_the_mode_at_once() -> str:
    """Look whether the robot's last state arrives while the simulation is paused."""
    _ensure_standing()
    with _paused_simulation():
        node = _start("robot_mode.py", {"on_state() missing": "pass the callback itself: self.on_state"})
        comes_true(lambda: _printed_state(node) or not node.is_running, 5.0)
        _require_running(node, {})
        if not _printed_state(node):
            raise _why_no_state(node)
        return f"paused, and it knows at once: {_printed_state(node)!r}"


def walks_one_metre() -> str:
    """Look how far the robot walks, and that the node does not end before the first odom."""
    _ensure_standing()
    with _paused_simulation():
        hints = {"NoneType": "return from on_timer as long as self.start is None"}
        node = _start("one_metre.py", hints)
        comes_true(lambda: not node.is_running, 1.0)
        _require_running(node, hints)
    before = pose()

    def walked() -> float:
        """How far ahead of its start the robot is."""
        now = pose()
        return (now.x - before.x) * math.cos(before.yaw) + (now.y - before.y) * math.sin(before.yaw)

    began = time.monotonic()
    comes_true(lambda: mode() == "WALKING" or not node.is_running, 5.0)
    comes_true(lambda: mode() != "WALKING" or walked() > ACCEPTED_DISTANCES[1] or not node.is_running, 20.0)
    _require_running(
        node, {"must be of type 'float'": "a float64 field needs a float: 0.3, not an int", **hints}
    )
    distance = f"{walked():.2f} m"
    expect(
        walked() > 0.03,
        seen=f"the robot is {distance} ahead of its start",
        expected="1 m, then standing",
        next="make a Twist, set its linear.x to 0.3 while the distance is below 1.0, and publish it with self.cmd_vel",
    )
    expect(
        walked() > ACCEPTED_DISTANCES[0],
        seen=f"the robot went {distance} and stopped",
        expected="1 m, then standing",
        next="publish in every call of on_timer, until the distance is 1.0: the robot obeys a command for 0.5 s only",
    )
    expect(
        mode() != "WALKING",
        seen=f"after {distance} the robot still walks",
        expected="1 m, then standing",
        next="compare math.dist(self.start, self.here) with 1.0 in every call of on_timer",
    )
    return f"the robot walked {distance} in {time.monotonic() - began:.0f} s and stands"


def _start(file: str, hints: Mapping[str, str]) -> StudentNode:
    """Start the student's node; when it ends at once, say of what and what to do."""
    robot_process()  # without a robot the error should say so
    try:
        return run_node(file)
    except NodeEndedError as problem:
        raise _ended(str(problem), file, hints) from None


def _require_running(node: StudentNode, hints: Mapping[str, str]) -> None:
    if not node.is_running:
        raise _ended(node.log(), node.file.name, hints)


def _ended(log: str, file: str, hints: Mapping[str, str]) -> Exception:
    reason = last_error_or_line(log, file)
    advice = next((hint for part, hint in hints.items() if part in reason), NO_ERROR_HINT)
    return not_yet(f"the node has ended: {reason}", "a node that runs", advice)


def _received_topics(log: str) -> set[str]:
    """The topics in the line that monitor.py prints."""
    line = re.search(r"^received: (.+)$", log, re.MULTILINE)
    return set(line[1].split(", ")) if line else set()


def _mismatches(node: StudentNode) -> str:
    """Where the node requests more than is offered."""
    found = [
        f"On {topic.name} you request {end.qos_in_words()}, and the publisher offers {offered.qos_in_words()}."
        for topic in topics_in_graph(*TOPICS)
        for end in topic.subscriptions
        for offered in topic.incompatible_with(end)
        if end.node == f"{NAMESPACE}/monitor"
    ]
    return " ".join(found)


def _printed_state(node: StudentNode) -> str:
    """The first line that on_state has printed, or ""."""
    line = re.search(r"^mode \d, motors .*$", node.log(), re.MULTILINE)
    return line[0] if line else ""


def _why_no_state(node: StudentNode) -> Exception:
    """Why the node knows nothing, from what it subscribes to."""
    expected = "on_state is called although the simulation is paused"
    mine = _subscriptions_of(f"{NAMESPACE}/robot_mode")
    states = mine.get(f"{NAMESPACE}/robot_state")
    if not mine:
        return not_yet("the node has no subscription", expected, "call self.create_subscription")
    if states is None:
        return not_yet(
            f"it subscribes to {', '.join(mine)}",
            f"a subscription to {NAMESPACE}/robot_state",
            'subscribe to "robot_state", without a slash in front',
        )
    if printed := node.log().strip():
        return not_yet(
            f"it printed {printed.splitlines()[-1][:80]!r}", expected, "give self.on_state as the callback"
        )
    if "transient local" not in states:
        states += ", volatile"
        advice = "request durability=DurabilityPolicy.TRANSIENT_LOCAL in a QoSProfile"
    else:
        advice = "leave the reliability at its default: a kept message goes only to a reliable subscription"
    return not_yet(f"nothing arrived; your subscription requests {states}", expected, advice)


def _subscriptions_of(name: str) -> dict[str, str]:
    """What a node subscribes to, with the QoS in words."""
    return {
        topic.name: end.qos_in_words()
        for topic in topics_in_graph()
        for end in topic.subscriptions
        if end.node == name
    }


def _ensure_standing() -> None:
    """Have a robot that stands."""
    robot_process()
    if mode() in ("FALLEN", "OFF"):
        restart_robot()
    comes_true(lambda: mode() == "STANDING", 5.0)


@contextmanager
def _paused_simulation() -> Iterator[None]:
    """The simulation stands still, so the robot publishes nothing."""
    call(PAUSE_SERVICE, SetBool, SetBool.Request(data=True))
    try:
        yield
    finally:
        call(PAUSE_SERVICE, SetBool, SetBool.Request(data=False))


GAPS = (
    Gap("monitor_fixed.py", receives_five_topics),
    Gap("robot_mode.py", knows_the_mode_at_once),
    Gap("one_metre.py", walks_one_metre),
)
