"""Chapter 1: robot and graph."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from std_srvs.srv import SetBool

from lab.client.connection import NAMESPACE
from lab.client.formatting import fixed
from lab.client.graph import topics_in_graph
from lab.client.services import call
from lab.client.topics import mode, pose
from lab.client.waiting import becomes_true
from lab.errors import NodeEndedError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import advice_on, blocked_or, last_error_or_line
from lab.running.robot import restart_robot, robot_process
from lab.running.student_nodes import StudentNode, run_node

TOPICS = {"odom", "robot_state", "battery_state", "joint_states", "imu"}
PAUSE_SERVICE = "/sim/set_pause"
NO_ODOM = (
    "So no odom arrives, and self.here stays the same: compare once in each call of on_timer, without a loop"
)
ACCEPTED_DISTANCES = (0.9, 1.5)  # m; the robot finishes its step after the last command


def receives_five_topics() -> str:
    """Check that messages of all topics arrive with the student's QoS profiles."""
    node = _start(
        "monitor_fixed.py",
        {
            "NoneType": "end each path of qos with `return` and a profile",
            "depth settings are required": "give the profile a depth: QoSProfile(depth=10, …)",
        },
    )
    becomes_true(lambda: "received:" in node.log() or not node.is_running, 10.0)
    _require_running(node, {})
    received = _received_topics(node.log())
    silent = ", ".join(sorted(TOPICS - received))
    expect(
        received == TOPICS,
        seen=f"no message arrived on {silent}. {_mismatches(node)}",
        expected="messages on all five topics",
        next="for these topics, request no more than the publisher offers",
    )
    return f"messages arrived on {', '.join(sorted(received))}"


def receives_the_stored_state() -> str:
    """Check that the last robot_state arrives while the simulation is paused and the robot publishes nothing."""
    _ensure_standing()
    with _paused_simulation():
        node = _start("robot_mode.py", {"on_state() missing": "pass the callback itself: self.on_state"})
        becomes_true(lambda: _printed_state(node) or not node.is_running, 5.0)
        _require_running(node, {})
        if not _printed_state(node):
            raise _why_no_state(node)
        return f"it received the last state although the simulation was paused: {_printed_state(node)!r}"


def walks_one_metre() -> str:
    """Check how far the robot walks, and that the node keeps running before the first odom."""
    _ensure_standing()
    with _paused_simulation():
        hints = {"NoneType": "return from on_timer as long as self.start is None"}
        node = _start("one_metre.py", hints)
        becomes_true(lambda: not node.is_running, 1.0)
        _require_running(node, hints)
    before = pose()

    def walked() -> float:
        """Return how far ahead of its start the robot is, in m."""
        now = pose()
        return (now.x - before.x) * math.cos(before.yaw) + (now.y - before.y) * math.sin(before.yaw)

    began = time.monotonic()
    becomes_true(lambda: mode() == "WALKING" or not node.is_running, 5.0)
    becomes_true(lambda: mode() != "WALKING" or walked() > ACCEPTED_DISTANCES[1] or not node.is_running, 20.0)
    _require_running(
        node, {"must be of type 'float'": "a float64 field needs a float: 0.3, not an int", **hints}
    )
    distance = f"{fixed(walked(), 2)} m"

    def expect_a_metre(condition: bool, seen: str, next: str) -> None:
        expect(
            condition,
            seen=seen,
            expected="the robot walks 1 m and stands",
            next=next if condition else blocked_or(node, next, NO_ODOM),
        )

    expect_a_metre(
        walked() > 0.03,
        f"the robot is {distance} ahead of its start",
        "make a Twist, set its linear.x to 0.3 while the distance is below 1.0, and publish it with self.cmd_vel",
    )
    expect_a_metre(
        walked() > ACCEPTED_DISTANCES[0],
        f"the robot walked {distance} and stopped",
        "publish in every call of on_timer until the distance is 1.0: each command is valid for 0.5 s only",
    )
    expect_a_metre(
        mode() != "WALKING",
        f"after {distance} the robot still walks",
        "compare math.dist(self.start, self.here) with 1.0 in every call of on_timer",
    )
    return f"the robot walked {distance} in {time.monotonic() - began:.0f} s and stands"


def _start(file: str, hints: Mapping[str, str]) -> StudentNode:
    """Start the student's node.

    Raises GapError when the node ends at once; the message has its error and the advice that belongs to it.
    """
    robot_process()  # raises an error if no robot runs
    try:
        return run_node(file)
    except NodeEndedError as problem:
        raise _ended(str(problem), file, hints) from None


def _require_running(node: StudentNode, hints: Mapping[str, str]) -> None:
    if not node.is_running:
        raise _ended(node.log(), node.file.name, hints)


def _ended(log: str, file: str, hints: Mapping[str, str]) -> Exception:
    reason = last_error_or_line(log, file)
    return not_yet(f"the node has ended: {reason}", "a node that runs", advice_on(log, reason, hints))


def _received_topics(log: str) -> set[str]:
    """Return the topics in the line "received: …" that the node prints."""
    line = re.search(r"^received: (.+)$", log, re.MULTILINE)
    return set(line[1].split(", ")) if line else set()


def _mismatches(node: StudentNode) -> str:
    """Return a sentence for each topic whose subscription requests more than the publisher offers."""
    found = [
        f"On {topic.name} you request {end.qos_in_words()}, but the publisher offers {offered.qos_in_words()}."
        for topic in topics_in_graph(*TOPICS)
        for end in topic.subscriptions
        for offered in topic.incompatible_with(end)
        if end.node == f"{NAMESPACE}/monitor"
    ]
    return " ".join(found)


def _printed_state(node: StudentNode) -> str:
    """Return the first line that on_state has printed; "" if it has printed none."""
    line = re.search(r"^mode \d, motors .*$", node.log(), re.MULTILINE)
    return line[0] if line else ""


def _why_no_state(node: StudentNode) -> Exception:
    """Return the error for a node whose on_state was not called, with the cause that its subscriptions show."""
    expected = "on_state is called although the simulation is paused"
    mine = _subscriptions_of(f"{NAMESPACE}/robot_mode")
    states = mine.get(f"{NAMESPACE}/robot_state")
    if not mine:
        return not_yet("the node has no subscription", expected, "call self.create_subscription")
    if states is None:
        return not_yet(
            f"the node subscribes to {', '.join(mine)}",
            f"a subscription to {NAMESPACE}/robot_state",
            'subscribe to "robot_state", without a leading slash',
        )
    if printed := node.log().strip():
        return not_yet(
            f"the node printed {printed.splitlines()[-1][:80]!r}",
            expected,
            "pass self.on_state as the callback",
        )
    if "transient local" not in states:
        at_fault = "volatile messages, and so gets none from before its start"
        advice = "request durability=DurabilityPolicy.TRANSIENT_LOCAL in a QoSProfile"
    else:
        at_fault = "best effort"
        advice = (
            "leave the reliability at its default: only a reliable subscription receives the stored message"
        )
    return not_yet(f"no message arrived; your subscription requests {at_fault}", expected, advice)


def _subscriptions_of(name: str) -> dict[str, str]:
    """Return the topics to which a node subscribes, each with the requested QoS in words."""
    return {
        topic.name: end.qos_in_words()
        for topic in topics_in_graph()
        for end in topic.subscriptions
        if end.node == name
    }


def _ensure_standing() -> None:
    """Restart a robot that has fallen or is switched off, and wait until it stands."""
    robot_process()
    if mode() in ("FALLEN", "OFF"):
        restart_robot()
    becomes_true(lambda: mode() == "STANDING", 5.0)


@contextmanager
def _paused_simulation() -> Iterator[None]:
    """Pause the simulation while the block runs, so that the robot publishes nothing."""
    call(PAUSE_SERVICE, SetBool, SetBool.Request(data=True))
    try:
        yield
    finally:
        call(PAUSE_SERVICE, SetBool, SetBool.Request(data=False))


GAPS = (
    Gap("monitor_fixed.py", receives_five_topics),
    Gap("robot_mode.py", receives_the_stored_state),
    Gap("one_metre.py", walks_one_metre, duration=8),
)
