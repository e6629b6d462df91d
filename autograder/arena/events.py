"""The events that an arena can report; every time is in seconds on the arena's clock.

The arena's own events are defined here and in `scripted_events`; those of its clients and of the simulator are in
`ros_runtime.record`.
"""

from __future__ import annotations

from typing import Any, Literal

from autograder.arena.scripted_events import *  # noqa: F403
from ros_runtime.record.client_events import *  # noqa: F403
from ros_runtime.record.event import Event
from ros_runtime.record.ground_truth import *  # noqa: F403


class NodeStarted(Event):
    """The student's process was started."""


class NodeReady(Event):
    """The endpoints the scenario waits for are matched; `waited` s after the node was started."""

    waited: float


class NodeNotReady(Event):
    """Endpoints never appeared: `missing` names them, `offered` lists what there is instead, as 'name [type]'."""

    missing: list[str]
    offered: list[str]
    waited: float


class NodeOutput(Event):
    """A line the student's process printed."""

    stream: Literal["stdout", "stderr"]
    text: str


class NodeTyped(Event):
    """The scenario typed a line on the student's stdin; None: it ended the input, as Ctrl-D does."""

    line: str | None


class NodeSignalled(Event):
    """The scenario sent the student's process a signal."""

    signal: str


class NodeExited(Event):
    """The student's process ended by itself or by a signal (negative)."""

    returncode: int


class NodeKilled(Event):
    """The student's processes were ended because they exceeded a limit."""

    reason: str


class ArenaOverfull(Event):
    """The controller ended the arena: student, robot and grader together exceeded its memory limit.

    Robot and grader always use about a quarter of the limit, so the student's program used the rest.
    """

    memory_mib: float
    limit_mib: int


class NodeUsage(Event):
    """Processor time and memory of the student's program and all its child processes.

    Attributes:
        cpu, wall: processor time over real time, s.
        peak_memory_mib: resident.
        cpu_in_time: the part of `cpu` since the arena's clock reached its scale, s.
        in_time: time on the arena's clock since then, s.
        burst: the highest number of busy processors, averaged over half a second of real time, since then.
    """

    cpu: float
    wall: float
    peak_memory_mib: float
    cpu_in_time: float = 0.0
    in_time: float = 0.0
    burst: float = 0.0


class NodeTopics(Event):
    """Full names of the topics that nodes other than robot and grader publish and subscribe to.

    For diagnosis only: no verdict may depend on it.
    """

    publishes: list[str]
    subscribes: list[str]


class NodeStack(Event):
    """Stack traces of a student's program that did not answer or exit and was ended; printed by faulthandler.

    For diagnosis only: the program itself could have printed these lines.
    """

    lines: list[str]


class MessageReceived(Event):
    """The student's node published a message on a topic that the grader subscribes to."""

    topic: str
    message: Any


class WokenLate(Event):
    """A sleep of the agent took `late` s longer than requested: the longest delay so far."""

    late: float


class Starved(Event):
    """Processor time (s) that the student's program missed because other programs occupied the processors.

    `seconds`: the worst rate, for one second on the arena's clock; `altogether`: the sum since its start, real time.
    """

    seconds: float
    altogether: float = 0.0


class Mark(Event):
    """A moment that the scenario names, so that checks can refer to it."""

    name: str


class StepsPlanned(Event):
    """The scenario's steps in words, in their order."""

    words: list[str]


class PhaseEnded(Event):
    """What a phase of the arena cost, where that is measured: wall and processor time of all its processes (s)."""

    name: str
    wall: float
    cpu: float


class ScenarioEnded(Event):
    """The scenario ran to its end."""


class ScenarioFailed(Event):
    """The scenario could not be carried out, through no fault of the student's."""

    reason: str


class RecordDropped(Event):
    """`count` events of the kind `what`, caused by the student's processes, were dropped.

    `seconds` is the time from the first event of that kind to the last one dropped.
    """

    what: str
    count: int
    seconds: float


class GraphFlooded(Event):
    """The ROS graph had too many nodes, an invalid name, or made queries fail; `nodes` is the number of nodes."""

    nodes: int
    reason: str


class CommandSent(Event):
    """The scenario sent the robot a command; RobotCommanded with the same command follows when it takes effect."""

    command: dict[str, Any]


_EVENTS = [each for each in vars().values() if isinstance(each, type) and each in Event.__subclasses__()]
KINDS: dict[str, type[Event]] = {each.kind: each for each in _EVENTS}
"""Every type of event by its kind."""
