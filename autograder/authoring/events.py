"""What an arena can report, one type an event, every time in seconds on the arena's own clock.

The lines come from a process that parses bytes written by untrusted code, so they are validated here before
anything judges them.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

Message = dict[str, Any]
"""A ROS message as nested dicts and lists, field by field."""


class _Event(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=True)
    t: float


class NodeStarted(_Event):
    """The student's process exists."""

    kind: Literal["node_started"] = "node_started"


class NodeReady(_Event):
    """The endpoints the scenario waits for are matched; `waited` s after the node was started."""

    kind: Literal["node_ready"] = "node_ready"
    waited: float


class NodeNotReady(_Event):
    """They never were; `missing` names them, `offered` lists what the student's node does offer as 'name [type]'."""

    kind: Literal["node_not_ready"] = "node_not_ready"
    missing: list[str]
    offered: list[str]
    waited: float


class NodeOutput(_Event):
    """A line the student's process printed."""

    kind: Literal["node_output"] = "node_output"
    stream: Literal["stdout", "stderr"]
    text: str


class NodeSignalled(_Event):
    """The scenario sent the student's process a signal."""

    kind: Literal["node_signalled"] = "node_signalled"
    signal: str


class NodeExited(_Event):
    """The student's process ended by itself or by a signal (negative)."""

    kind: Literal["node_exited"] = "node_exited"
    returncode: int


class NodeKilled(_Event):
    """The student's processes were ended because they used more than they may."""

    kind: Literal["node_killed"] = "node_killed"
    reason: str


class NodeUsage(_Event):
    """What the student's processes used: processor time (s) over `wall` s of real time, peak memory (MiB)."""

    kind: Literal["node_usage"] = "node_usage"
    cpu: float
    wall: float
    peak_memory_mib: float


class ServiceCalled(_Event):
    kind: Literal["service_called"] = "service_called"
    call: str
    service: str
    request: Message


class ServiceAnswered(_Event):
    kind: Literal["service_answered"] = "service_answered"
    call: str
    response: Message


class GoalSent(_Event):
    kind: Literal["goal_sent"] = "goal_sent"
    goal: str
    action: str
    request: Message


class GoalAnswered(_Event):
    kind: Literal["goal_answered"] = "goal_answered"
    goal: str
    accepted: bool


class FeedbackReceived(_Event):
    kind: Literal["feedback"] = "feedback"
    goal: str
    feedback: Message


class StatusSeen(_Event):
    """The goal's status on the action's status topic changed (action_msgs/GoalStatus)."""

    kind: Literal["status"] = "status"
    goal: str
    status: int


class CancelSent(_Event):
    """`by` is the client that asked; `goal` is empty when it asked to cancel every goal."""

    kind: Literal["cancel_sent"] = "cancel_sent"
    cancel: str
    goal: str
    by: str


class CancelAnswered(_Event):
    """`canceling` names the goals the server agreed to cancel."""

    kind: Literal["cancel_answered"] = "cancel_answered"
    cancel: str
    return_code: int
    canceling: list[str]


class ResultReceived(_Event):
    kind: Literal["result"] = "result"
    goal: str
    status: int
    result: Message


class Unanswered(_Event):
    """The scenario stopped waiting, after `waited` s, for the answer to a call, goal, cancel or result, or an end."""

    kind: Literal["unanswered"] = "unanswered"
    what: Literal["call", "goal", "cancel", "result", "end"]
    id: str
    waited: float


class ServiceOffered(_Event):
    """The grader began to play a service; `server` names it, `type` is the ROS name of its type."""

    kind: Literal["service_offered"] = "service_offered"
    service: str
    server: str
    type: str


class ServiceWithdrawn(_Event):
    """A played service ceased to exist, together with the requests it was working on."""

    kind: Literal["service_withdrawn"] = "service_withdrawn"
    service: str
    server: str


class RequestReceived(_Event):
    """A request of the student's client reached a played service."""

    kind: Literal["request_received"] = "request_received"
    request: str
    service: str
    server: str
    fields: Message


class ReplySent(_Event):
    kind: Literal["reply_sent"] = "reply_sent"
    request: str
    response: Message


class WokenLate(_Event):
    """A sleep of the arena's trusted process took `late` s longer than asked for, more than any before it."""

    kind: Literal["woken_late"] = "woken_late"
    late: float


class Starved(_Event):
    """The student's program was ready to run and got no processor, for so many seconds of the arena's clock."""

    kind: Literal["starved"] = "starved"
    seconds: float


class Mark(_Event):
    """A moment the scenario names, so that checks can refer to it."""

    kind: Literal["mark"] = "mark"
    name: str


class PhaseEnded(_Event):
    """What a phase of the arena cost, where that is measured: wall and processor time of all its processes (s)."""

    kind: Literal["phase"] = "phase"
    name: str
    wall: float
    cpu: float


class ScenarioEnded(_Event):
    """The scenario ran to its end."""

    kind: Literal["scenario_ended"] = "scenario_ended"


class ScenarioFailed(_Event):
    """The scenario could not be carried out, for a reason that is not the student's."""

    kind: Literal["scenario_failed"] = "scenario_failed"
    reason: str


class RecordDropped(_Event):
    """What the student's processes sent and was not kept: `count` events of the kind `what`.

    `seconds` is the time from the first event of that kind to the last one dropped.
    """

    kind: Literal["dropped"] = "dropped"
    what: str
    count: int
    seconds: float


class TooLarge(_Event):
    """Something the student's processes sent ("answer", "feedback", …) had more `bytes` than are read: the `limit`.

    `id` names the call, goal or cancel it belongs to, where it has one.
    """

    kind: Literal["too_large"] = "too_large"
    what: str
    id: str
    bytes: int
    limit: int


class GraphFlooded(_Event):
    """The ROS graph held what no sound program puts there; `nodes` is how many nodes were seen in it."""

    kind: Literal["graph_flooded"] = "graph_flooded"
    nodes: int
    reason: str


class RobotReady(_Event):
    kind: Literal["ready"] = "ready"


class RobotTruth(_Event):
    """The robot as the simulator has it (50 Hz): base_link in odom (m, rad), speed over ground (m/s).

    `up` is 1 when upright; `lag` is how far (s) the simulation was behind the arena's clock.
    """

    kind: Literal["robot"] = "robot"
    simulated: float
    lag: float
    x: float
    y: float
    z: float
    yaw: float
    speed: float
    turn_rate: float
    up: float
    mode: int
    motors_enabled: bool
    steps: int
    battery: float


class BatteryPublished(_Event):
    """What the robot published on battery_state: percentage 0..1, V, A."""

    kind: Literal["battery"] = "battery"
    percentage: float
    voltage: float
    current: float


class JointsPublished(_Event):
    """What the robot published on joint_states: a position for each name, rad (fingers: m)."""

    kind: Literal["joints"] = "joints"
    names: list[str]
    positions: list[float]


class ArmReported(_Event):
    """Where elbow and hand (between the fingers) of an arm were: m from its shoulder, along the torso's x, y and z."""

    kind: Literal["arm"] = "arm"
    side: str
    elbow: list[float]
    hand: list[float]


class RobotPeers(_Event):
    """How many subscribers and publishers of other nodes the robot is connected to, by topic."""

    kind: Literal["peers"] = "peers"
    subscribers: dict[str, int]
    publishers: dict[str, int]


class CommandSent(_Event):
    """The scenario sent the robot a command; RobotCommanded with the same command follows when it takes effect."""

    kind: Literal["command_sent"] = "command_sent"
    command: Message


class RobotCommanded(_Event):
    """A command of the scenario took effect in the simulator."""

    kind: Literal["command"] = "command"
    command: Message


class RobotRefused(_Event):
    """So many messages of a topic (the largest of so many bytes) the robot has not heard so far, and why."""

    kind: Literal["refused"] = "refused"
    topic: str
    count: int
    bytes: int
    reason: str


Event = Annotated[
    NodeStarted
    | NodeReady
    | NodeNotReady
    | NodeOutput
    | NodeSignalled
    | NodeExited
    | NodeKilled
    | NodeUsage
    | RecordDropped
    | ServiceCalled
    | ServiceAnswered
    | GoalSent
    | GoalAnswered
    | FeedbackReceived
    | StatusSeen
    | CancelSent
    | CancelAnswered
    | ResultReceived
    | Unanswered
    | ServiceOffered
    | ServiceWithdrawn
    | RequestReceived
    | ReplySent
    | WokenLate
    | Starved
    | Mark
    | PhaseEnded
    | ScenarioEnded
    | ScenarioFailed
    | TooLarge
    | GraphFlooded
    | CommandSent
    | RobotReady
    | RobotTruth
    | BatteryPublished
    | JointsPublished
    | ArmReported
    | RobotPeers
    | RobotRefused
    | RobotCommanded,
    Field(discriminator="kind"),
]

_ADAPTER: TypeAdapter[Event] = TypeAdapter(Event)


def parse_event(line: bytes | str) -> Event:
    """Read one line of an arena's report; a pydantic.ValidationError says what is wrong with it."""
    return _ADAPTER.validate_json(line)
