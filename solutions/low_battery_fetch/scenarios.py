"""Two played actions and a played battery for a fetching server. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import BatteryState

from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from autograder.arena.scripted_topic import ScriptedTopic
from autograder.arena.stage import ActionClient, Goal, Stage
from humanoid_interfaces.action import NavigateToPose, PickAndPlace

NAVIGATE, PICK = "navigate_to_pose", "pick_and_place"
PLACE = (0.4, -0.1, 0.75)  # m in odom
STAGES = ("approaching", "grasping", "lifting", "moving", "placing", "retreating")
BEFORE_THE_GRASP = STAGES[:2]
# The four steps of a fetch, and the stage of the arm at which something happens ("": a step that walks).
MOMENTS = {
    "to the table": (1, ""),
    "approaching the cup": (2, "approaching"),
    "grasping the cup": (2, "grasping"),
    "lifting the cup": (2, "lifting"),
    "placing the cup": (2, "placing"),
    "going home": (3, ""),
    "approaching the tray": (4, "approaching"),
    "putting it down": (4, "placing"),
}
FULL = 0.8
SETTLING = 1.5  # s for the battery's level, and for the servers, to be known to the node
AFTERWARDS = 3.0  # s after a result in which nothing more may be asked for
SOON = 15.0  # s for a goal of the node, or for its feedback
WHOLE = 30.0  # s for a fetch
UNDER_WAY = 3  # feedback messages of the step, or of its stage
EVERY = 0.2  # s between two of them
WALK = 2.0  # s
RECOVERING = 1.2  # s
LONG = 12  # messages of a stage in which something happens
ENDLESS = 150
FAR_TOO_LATE = 6.5  # s for a goal's answer, after the 5 s that a client waits


class Played(NamedTuple):
    """The student's action, and what the grader plays."""

    fetch: ActionClient
    actions: dict[str, ScriptedAction]
    battery: ScriptedTopic

    def level(self, percentage: float) -> None:
        """Publish a level of the battery."""
        self.battery.publish(BatteryState(percentage=percentage, present=True))


def interrupt(stage: Stage) -> None:
    """Press Ctrl-C while no goal is active."""
    _open(stage)
    stage.interrupt_node()


def good(stage: Stage, goal: dict, levels: Sequence[float], walk: float = WALK) -> None:
    """All goes well, each walk takes so long (s), and the battery runs through these levels on the way."""
    played = _open(stage, {NAVIGATE: [_walk(walk)]})
    fetch = played.fetch.send_and_wait(_goal(**goal), as_="fetch")
    for level in levels:
        stage.wait(2 * EVERY)
        played.level(level)
    fetch.wait_for_result(WHOLE + 2 * walk)
    stage.wait(AFTERWARDS)


def ask_for_the_impossible(stage: Stage) -> None:
    """Ask for a place in a frame that nobody knows, for one that is no number, and for forces that are none."""
    fetch = _open(stage).fetch
    wrong = {
        "wrong frame": _goal(frame="map"),
        "NaN position": _goal(place=(math.nan, 0.0, 0.7)),
        "NaN force": _goal(force=math.nan),
        "no force": _goal(force=0.0),
    }
    for name, goal in wrong.items():
        fetch.send_and_wait(goal, as_=name)
    stage.wait(AFTERWARDS)


def low_before(stage: Stage, level: float | None, then: float) -> None:
    """Ask while the battery is at this level (None: it has said nothing), and again when it is at another."""
    played = _open(stage, level=level)
    for name in ("low battery", "charged"):
        fetch = played.fetch.send_and_wait(_goal(), as_=name)
        fetch.wait_for_result(WHOLE)
        stage.wait(AFTERWARDS)
        played.level(then)
        stage.wait(SETTLING)


def drop(
    stage: Stage,
    moment: str,
    level: float,
    agreed: bool = True,
    canceled_after: float = 1.0,
    then: float | None = None,
) -> None:
    """The battery drops at a moment; a request to cancel is agreed to, and obeyed so long (s) afterwards.

    If it is refused, what is under way goes on to its own end. `then`: 1.2 s later the battery is at this level.
    """
    script = CancelScript(agreed=agreed, ends_after=canceled_after)
    played = _open(stage, _scripts(moment, script, endless=agreed))
    fetch = played.fetch.send_and_wait(_goal(), as_="fetch")
    if _is_at(stage, played, fetch, moment):
        played.level(level)
        if then is not None:
            stage.wait(RECOVERING)
            played.level(then)
    fetch.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def drop_before_acceptance(stage: Stage, level: float) -> None:
    """The battery drops while the first walk waits for its answer, which takes 2 s."""
    first = _walk(None, after=2.0, cancel=CancelScript(ends_after=1.0))
    played = _open(stage, {NAVIGATE: [first, _walk()]})
    fetch = played.fetch.send_and_wait(_goal(), as_="fetch")
    if stage.wait_until(lambda: played.actions[NAVIGATE].goals or fetch.has_ended, SOON):
        stage.wait(0.5)
        played.level(level)
    fetch.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def cancel(stage: Stage, moment: str, agreed: bool = True, canceled_after: float = 1.0) -> None:
    """Cancel the fetch at a moment; the cancel of what is under way is agreed to and obeyed so long (s) afterwards.

    If it is refused, what is under way goes on to its own end.
    """
    script = CancelScript(agreed=agreed, ends_after=canceled_after)
    played = _open(stage, _scripts(moment, script, endless=agreed))
    fetch = played.fetch.send_and_wait(_goal(), as_="fetch")
    if _is_at(stage, played, fetch, moment):
        fetch.cancel().wait()
    fetch.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def cancel_before_acceptance(stage: Stage) -> None:
    """Cancel the fetch while the first walk waits for its answer, which takes 2 s."""
    first = _walk(None, after=2.0, cancel=CancelScript(ends_after=1.0))
    played = _open(stage, {NAVIGATE: [first, _walk()]})
    fetch = played.fetch.send_and_wait(_goal(), as_="fetch")
    if stage.wait_until(lambda: played.actions[NAVIGATE].goals or fetch.has_ended, SOON):
        stage.wait(0.5)
        fetch.cancel().wait()
    fetch.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def fail(stage: Stage, step: int, how: str, code: int = 0, message: str = "", again: bool = False) -> None:
    """The child of a step (1 to 4) fails in a way; `again`: then a second fetch finds all well."""
    name, number = _child(step)
    scripts: dict[str, list[GoalScript]] = {NAVIGATE: [_walk()], PICK: [_work()]}
    scripts[name] = [*scripts[name] * (number - 1), _failing(name, how, code, message), *scripts[name]]
    played = _open(stage, scripts)
    fetch = played.fetch.send_and_wait(_goal(), as_="fetch")
    if how == "dies" and _is_under_way(stage, played, fetch, step):
        played.actions[name].withdraw()
    fetch.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)
    if again:
        played.fetch.send_and_wait(_goal(), as_="again").wait_for_result(WHOLE)
        stage.wait(AFTERWARDS)


def without_server(stage: Stage, missing: str) -> None:
    """Nobody offers one of the two actions."""
    played = _open(stage, missing=missing)
    played.fetch.send_and_wait(_goal(), as_="fetch").wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


def preempt(stage: Stage, moment: str, canceled_after: float, goal: dict) -> None:
    """Send another goal at a moment of the first; what is under way ends so long (s) after it is canceled."""
    played = _open(stage, _scripts(moment, CancelScript(ends_after=canceled_after), endless=True))
    old = played.fetch.send_and_wait(_goal(), as_="old")
    if _is_at(stage, played, old, moment):
        new = played.fetch.send_and_wait(_goal(**goal), as_="new")
        old.wait_for_result(WHOLE)
        new.wait_for_result(WHOLE)
    stage.wait(AFTERWARDS)


# -- what is played ---------------------------------------------------------------------------------------------------


def _open(
    stage: Stage,
    scripts: dict[str, list[GoalScript]] | None = None,
    *,
    level: float | None = FULL,
    missing: str = "",
) -> Played:
    """Play the two actions, where nothing else is said good ones, and a battery at this level (None: silent)."""
    played_scripts = {NAVIGATE: [_walk()], PICK: [_work()], **(scripts or {})}
    types = {NAVIGATE: NavigateToPose, PICK: PickAndPlace}
    actions = {
        name: stage.offer_action(name, types[name], *played_scripts[name])
        for name in types
        if name != missing
    }
    battery = stage.offer_topic("battery_state", BatteryState, latched=True)
    played = Played(stage.action("fetch", PickAndPlace), actions, battery)
    if level is not None:
        played.level(level)
    stage.open()
    stage.wait(SETTLING)
    return played


def _scripts(moment: str, cancel: CancelScript, *, endless: bool) -> dict[str, list[GoalScript]]:
    """Return scripts that let something happen at a moment.

    What is under way then comes to no end by itself if it is `endless`, and nothing is held yet.
    """
    step, stage = MOMENTS[moment]
    name, number = _child(step)
    if not stage:
        good, special = _walk(), _walk(None if endless and step == 1 else 4.0, cancel=cancel)
    else:
        good, special = _work(), _work(stage, endless=endless and stage in BEFORE_THE_GRASP, cancel=cancel)
    return {name: [*[good] * (number - 1), special, good]}


def _walk(seconds: float | None = WALK, **script: Any) -> GoalScript:
    """Return a walk that arrives after so long; None: never."""
    messages = ENDLESS if seconds is None else round(seconds / EVERY)
    result = NavigateToPose.Result(distance_traveled=1.2)
    return GoalScript(feedback=_way(messages), every=EVERY, ends_after=seconds, result=result, **script)


def _work(long: str = "", *, endless: bool = False, **script: Any) -> GoalScript:
    """Return a grasp that is well done, with one stage that takes longer than the others, or is `endless`."""
    stages: list[str] = []
    for stage in STAGES:
        stages += [stage] * ((ENDLESS if endless else LONG) if stage == long else 2)
        if stage == long and endless:
            break
    ends_after = None if endless else EVERY * len(stages)
    feedback = [_at_work(stage, 100.0 * n / len(stages)) for n, stage in enumerate(stages)]
    return GoalScript(feedback=feedback, every=EVERY, ends_after=ends_after, result=_taken(), **script)


def _failing(name: str, how: str, code: int, message: str) -> GoalScript:
    result_type = NavigateToPose.Result if name == NAVIGATE else PickAndPlace.Result
    feedback = _way(UNDER_WAY) if name == NAVIGATE else [_at_work(STAGES[0], 5.0)] * UNDER_WAY
    silent: dict[str, Any] = {"feedback": feedback, "every": EVERY, "ends_after": None}
    if how == "rejected":
        return GoalScript(accepted=False)
    if how == "aborted":
        result = result_type(error_code=code, error_msg=message)
        return GoalScript(
            feedback=feedback, every=EVERY, ends_after=1.0, status=GoalStatus.STATUS_ABORTED, result=result
        )
    if how == "canceled by another":
        return GoalScript(feedback=feedback, every=EVERY, ends_after=1.0, status=GoalStatus.STATUS_CANCELED)
    if how == "unanswered":
        return GoalScript(accepted=None)
    if how == "answered too late":
        return GoalScript(after=FAR_TOO_LATE, feedback=feedback, ends_after=None)
    if how == "silent":
        return GoalScript(**silent, cancel=CancelScript(ends_after=1.0))
    if how == "silent and deaf":
        return GoalScript(**silent, cancel=CancelScript(agreed=None))
    assert how == "dies", how
    return _walk(None) if name == NAVIGATE else _work(STAGES[0], endless=True)


def _way(messages: int) -> list[NavigateToPose.Feedback]:
    """Return the feedback of a robot that comes nearer."""
    way = [
        NavigateToPose.Feedback(status="walking", distance_remaining=1.2 * 0.95**number)
        for number in range(messages)
    ]
    for message in way:
        message.current_pose = _pose((0.0, 0.0, 0.0))
    return way


def _at_work(stage: str, percent: float) -> PickAndPlace.Feedback:
    return PickAndPlace.Feedback(stage=stage, percent_complete=percent, hand_pose=_pose((0.4, -0.2, 0.8)))


def _taken() -> PickAndPlace.Result:
    return PickAndPlace.Result(final_object_pose=_pose((0.41, -0.1, 0.75)), max_grasp_force=13.5)


def _goal(
    object_id: str = "cup",
    place: Sequence[float] = PLACE,
    force: float = 12.0,
    frame: str = "odom",
) -> PickAndPlace.Goal:
    return PickAndPlace.Goal(object_id=object_id, place_pose=_pose(place, frame), grasp_force=force)


def _pose(position: Sequence[float], frame: str = "odom") -> PoseStamped:
    pose = PoseStamped()
    pose.header.frame_id = frame
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = map(float, position)
    pose.pose.orientation.w = 1.0
    return pose


# -- when something happens -------------------------------------------------------------------------------------------


def _child(step: int) -> tuple[str, int]:
    """Return the action of a step, and the how-manieth of its goals it is."""
    return (NAVIGATE, PICK)[(step - 1) % 2], (step + 1) // 2


def _is_at(stage: Stage, played: Played, fetch: Goal, moment: str) -> bool:
    """Wait for a moment, and return whether it came."""
    step, at = MOMENTS[moment]
    before = 2 * STAGES.index(at) if at else 0  # messages of the stages before it
    return _is_under_way(stage, played, fetch, step, before + UNDER_WAY)


def _is_under_way(stage: Stage, played: Played, fetch: Goal, step: int, messages: int = UNDER_WAY) -> bool:
    """Wait until the child of a step has published so much feedback, and return whether it has."""
    name, number = _child(step)
    action = played.actions[name]
    stage.wait_until(lambda: action.goals >= number or fetch.has_ended, WHOLE)
    before = action.feedbacks
    stage.wait_until(lambda: action.feedbacks >= before + messages or fetch.has_ended, SOON)
    return not fetch.has_ended
