"""A played navigation, battery and robot for a guard to deal with. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from action_msgs.msg import GoalStatus
from sensor_msgs.msg import BatteryState

from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from autograder.arena.scripted_topic import ScriptedTopic
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState

ARGUMENTS = ("1.5", "-0.5", "0.4")  # x m, y m, yaw rad
FULL = 0.8
UNDER_WAY = 3  # feedback messages
BETWEEN = 0.3  # s between two levels of the battery
SOON = 15.0  # s for a goal, or a cancel, to come
WALK = 2.4  # s
LATE = 1.2  # s; with the 3 s that finding a client may take, it is within the 5 s that a client waits


class Played(NamedTuple):
    """What a scenario publishes on."""

    battery: ScriptedTopic
    robot: ScriptedTopic

    def level(self, percentage: float) -> None:
        """Publish a level of the battery."""
        self.battery.publish(BatteryState(percentage=percentage, present=True))

    def mode(self, mode: int) -> None:
        """Publish a mode of the robot."""
        self.robot.publish(RobotState(mode=mode, motors_enabled=True))


def good(stage: ClientStage, arguments: Sequence[str], levels: Sequence[float]) -> None:
    """The goal succeeds while the battery runs down through these levels."""
    navigation = _offer(stage, feedback=_way(8), ends_after=WALK)
    played = _start(stage, arguments)
    if _is_under_way(stage, navigation):
        _run_down(stage, played, levels)
    stage.wait_for_end()


def without_node(stage: ClientStage, arguments: Sequence[str]) -> None:
    """All is there, and the program is started with these arguments."""
    _offer(stage)
    _start(stage, arguments)
    stage.wait_for_end()


def low_before(stage: ClientStage, level: float) -> None:
    """The battery was at this level when it was published: once, and before the program began."""
    _offer(stage, feedback=_way(8), ends_after=WALK)
    _start(stage, level=level, again=False)
    stage.wait_for_end()


def level_before(stage: ClientStage, level: float) -> None:
    """The battery is at this level and stays there; the goal would succeed."""
    _offer(stage, feedback=_way(8), ends_after=WALK)
    _start(stage, level=level)
    stage.wait_for_end()


def without_battery(stage: ClientStage) -> None:
    """Nothing is ever published on battery_state."""
    _offer(stage)
    _start(stage, level=None)
    stage.wait_for_end()


def no_percentage_first(stage: ClientStage, levels: Sequence[float], then: float | None) -> None:
    """These levels come at first; 1.2 s later comes this one, or nothing."""
    _offer(stage, feedback=_way(8), ends_after=WALK)
    played = _start(stage, level=levels[0])
    for level in levels[1:]:
        played.level(level)
    if then is not None:
        stage.wait_until(stage.has_ended, LATE)
        played.level(then)
    stage.wait_for_end()


def nobody(stage: ClientStage) -> None:
    """There is no server."""
    _start(stage)
    stage.wait_for_end()


def late_server(stage: ClientStage, level: float) -> None:
    """The battery falls to this level while the server is still missing; then the server appears."""
    played = _start(stage)
    stage.wait(LATE / 2)
    played.level(level)
    stage.wait(LATE / 2)
    _offer(stage, feedback=_way(8), ends_after=WALK)
    stage.wait_for_end()


def rejecting(stage: ClientStage) -> None:
    """The goal is rejected."""
    _offer(stage, accepted=False)
    _start(stage)
    stage.wait_for_end()


def unanswered(stage: ClientStage) -> None:
    """The goal is never answered."""
    _offer(stage, accepted=None)
    _start(stage)
    stage.wait_for_end()


def silent(stage: ClientStage) -> None:
    """The goal is accepted, and then nothing is heard of it any more."""
    _offer(stage, ends_after=None)
    _start(stage)
    stage.wait_for_end()


def aborting(stage: ClientStage, error_code: int, error_msg: str) -> None:
    """The goal is aborted on the way, with this code and message."""
    result = NavigateToPose.Result(error_code=error_code, error_msg=error_msg)
    _offer(stage, feedback=_way(5), ends_after=1.0, status=GoalStatus.STATUS_ABORTED, result=result)
    _start(stage)
    stage.wait_for_end()


def canceled_by_another(stage: ClientStage) -> None:
    """Somebody else cancels the goal."""
    _offer(stage, feedback=_way(5), ends_after=1.0, status=GoalStatus.STATUS_CANCELED)
    _start(stage)
    stage.wait_for_end()


def interrupted(stage: ClientStage) -> None:
    """Ctrl-C while the goal is under way; the cancel is agreed to."""
    navigation = _offer(stage, feedback=_way(500), ends_after=None, cancel=CancelScript(ends_after=1.0))
    _start(stage)
    if _is_under_way(stage, navigation):
        stage.interrupt_program()
    stage.wait_for_end()


def dropping(
    stage: ClientStage,
    levels: Sequence[float],
    ends_after: float | None,
    stands_after: float | None,
    agreed: bool | None = True,
) -> None:
    """The robot walks, and the battery runs down through these levels.

    The goal is CANCELED `ends_after` s after the request to cancel; None: never. When that request has come and the
    last level is out, the robot stands `stands_after` s later; None: never. `agreed` None: there is no answer.
    """
    cancel = CancelScript(agreed=agreed, ends_after=ends_after)
    navigation = _offer(stage, feedback=_way(500), ends_after=None, cancel=cancel)
    played = _start(stage)
    if _is_under_way(stage, navigation):
        played.mode(RobotState.WALKING)
        stage.wait(BETWEEN)
        _run_down(stage, played, levels)
        canceled = stage.wait_until(lambda: navigation.cancels or stage.has_ended(), SOON)
        if canceled and stands_after is not None:
            stage.wait(stands_after)
            played.mode(RobotState.STANDING)
    stage.wait_for_end()


def dropping_on_the_spot(stage: ClientStage, level: float) -> None:
    """The battery drops before the robot has taken a step: robot_state said STANDING once, before the program began."""
    cancel = CancelScript(ends_after=0.5)
    navigation = _offer(stage, feedback=_way(500), ends_after=None, cancel=cancel)
    played = _start(stage)
    if _is_under_way(stage, navigation):
        played.level(level)
    stage.wait_for_end()


def dropping_before_acceptance(stage: ClientStage, level: float) -> None:
    """The battery drops while the goal waits for its answer, which takes 2 s; it comes to no other end."""
    cancel = CancelScript(ends_after=0.5)
    navigation = _offer(stage, after=2.0, feedback=_way(500), ends_after=None, cancel=cancel)
    played = _start(stage)
    if stage.wait_until(lambda: navigation.goals or stage.has_ended(), SOON):
        stage.wait(0.5)
        played.level(level)
    stage.wait_for_end()


def dropping_at_the_end(
    stage: ClientStage, level: float, ends_after: float, result_after: float, agreed: bool = True
) -> None:
    """The goal succeeds `ends_after` s after its acceptance, and its result takes so much longer (s).

    The battery drops 1.5 s after the third feedback; a cancel is agreed to, as long as the goal is active, but comes
    too late to change its end, or it is refused.
    """
    cancel = CancelScript(agreed=agreed, ends_after=None)
    navigation = _offer(
        stage, feedback=_way(500), ends_after=ends_after, result_after=result_after, cancel=cancel
    )
    played = _start(stage)
    if _is_under_way(stage, navigation):
        stage.wait(1.5)
        played.level(level)
    stage.wait_for_end()


def _offer(stage: ClientStage, **script: Any) -> ScriptedAction:
    return stage.offer_action("navigate_to_pose", NavigateToPose, GoalScript(**script))


def _start(
    stage: ClientStage,
    arguments: Sequence[str] = ARGUMENTS,
    *,
    level: float | None = FULL,
    again: bool = True,
) -> Played:
    """Run the program beside a robot that stands and a battery at this level, published once more if `again`."""
    played = Played(
        stage.offer_topic("battery_state", BatteryState, latched=True),
        stage.offer_topic("robot_state", RobotState, latched=True),
    )
    played.mode(RobotState.STANDING)
    if level is not None:
        played.level(level)
    stage.start_program(arguments)
    if level is not None and again:
        played.level(level)
    return played


def _run_down(stage: ClientStage, played: Played, levels: Sequence[float]) -> None:
    for level in levels:
        played.level(level)
        stage.wait(BETWEEN)


def _is_under_way(stage: ClientStage, navigation: ScriptedAction) -> bool:
    stage.wait_until(lambda: navigation.feedbacks >= UNDER_WAY or stage.has_ended(), SOON)
    return navigation.feedbacks >= UNDER_WAY


def _way(messages: int) -> list[NavigateToPose.Feedback]:
    """Feedback of a robot that comes nearer and never arrives."""
    feedback = [
        NavigateToPose.Feedback(status="walking", distance_remaining=1.6 * 0.9**number)
        for number in range(messages)
    ]
    for message in feedback:
        message.current_pose.header.frame_id = "odom"
        message.current_pose.pose.orientation.w = 1.0
    return feedback
