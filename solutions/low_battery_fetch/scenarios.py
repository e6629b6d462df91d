"""Scenarios for a fetch server, with two scripted actions and a scripted battery.

No expected responses here: this runs in the arena.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import BatteryState

from autograder.arena.poses import pose_at
from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Goal, Stage
from humanoid_interfaces.action import NavigateToPose, PickAndPlace

NAVIGATE, PICK = "navigate_to_pose", "pick_and_place"
STAGES = ("approaching", "grasping", "lifting", "moving", "placing", "retreating")
DISCOVERY_TIME = 1.5  # s for the node to receive the battery's level and discover the servers
RESULT_TIMEOUT = 25.0  # s for a fetch
SHORT_TIMEOUT = 3.0  # s for every fetch after one that timed out
UNDER_WAY = 3  # feedback messages; a walk or a stage that has sent so many is under way
FEEDBACK_PERIOD = 0.2  # s
WALK_DURATION = 1.6  # s
STAGE_DURATION = 0.4  # s
FORCES = (14.5, 13.5)  # N, of the goals of pick_and_place in turn
Script = Mapping[str, Any]


def in_order(
    stage: Stage, battery: float | None, walks: Sequence[Script], picks: Sequence[Script], steps: Steps
) -> None:
    """Offer both actions, each goal of which follows its script, and a battery, and carry out the steps.

    Keys of a script, all optional; times are in s:
        takes: duration of a walk.
        stages: duration of each stage of a pick.
        accepted: whether the goal is accepted; None: no response.
        answered_after: time until it is accepted or rejected.
        silent_after: time after which it sends no more feedback.
        silent_for: time after which it sends feedback again.
        ends, code, said: its final status, error_code and error_msg.
        stops: whether it accepts a cancel (None: no response), and the time until it is canceled.
    """
    actions = {
        NAVIGATE: stage.offer_action(NAVIGATE, NavigateToPose, *map(_walk, walks)),
        PICK: stage.offer_action(PICK, PickAndPlace, *map(_pick, picks, FORCES * len(picks))),
    }
    topic = stage.offer_topic("battery_state", BatteryState, latched=True)
    fetch = stage.action("fetch", PickAndPlace)
    sent: dict[str, Goal] = {}
    timeout = [RESULT_TIMEOUT]
    before: dict[str, int] = {}  # number of goals that each action had received before the last goal of fetch

    def publish(percentage: float) -> None:
        topic.publish(BatteryState(percentage=percentage, present=True))

    def go(name: str, *goal: Any) -> None:
        before.update({name: action.goals for name, action in actions.items()})
        sent[name] = fetch.send_and_wait(_goal(*goal), as_=name)

    def ask(name: str, path: str, value: Any) -> None:
        goal = _goal()
        *way, last = path.split(".")
        setattr(reduce(getattr, way, goal), last, value)
        sent[name] = fetch.send_and_wait(goal, as_=name)

    def send(step: int) -> ScriptedAction:
        """Wait until the goal for a step (1 to 4) of the last fetch has come."""
        action = actions[(PICK, NAVIGATE)[step % 2]]
        number, last = before[action.name] + (step + 1) // 2, list(sent.values())[-1]
        stage.wait_until(lambda: action.goals >= number or last.has_ended, timeout[0])
        return action

    def reach(step: int, at: str = "") -> None:
        """Wait until the child for a step of the last fetch is under way, or at a stage."""
        action, last = send(step), list(sent.values())[-1]
        seconds = picks[min(action.goals, len(picks)) - 1].get("stages", {})
        earlier = STAGES[: STAGES.index(at)] if at else ()
        number = (
            action.feedbacks
            + UNDER_WAY
            + sum(_messages(seconds.get(each, STAGE_DURATION)) for each in earlier)
        )
        stage.wait_until(lambda: action.feedbacks >= number or last.has_ended, timeout[0])

    def end(name: str) -> None:
        """Wait for the result of a fetch; only briefly if one has timed out before."""
        if sent[name].accepted and not sent[name].wait_for_result(timeout[0]):
            timeout[0] = SHORT_TIMEOUT

    vocabulary: Mapping[str, Callable[..., object]] = {
        "go": go,
        "ask": ask,
        "send": lambda step: send(step).goals,
        "reach": reach,
        "battery": publish,
        "cancel": lambda name: sent[name].cancel().wait(),
        "die": lambda name: actions[name].withdraw(),
        "end": end,
        "wait": stage.wait,
        "interrupt": stage.interrupt_node,
    }
    if battery is not None:
        publish(battery)
    stage.open()
    stage.wait(DISCOVERY_TIME)
    carry_out(stage, steps, vocabulary)


def _walk(script: Script) -> GoalScript:
    takes = script.get("takes", WALK_DURATION)
    way = [
        NavigateToPose.Feedback(
            status="walking", distance_remaining=1.2 * 0.95**number, current_pose=_pose(0.0, 0.0, 0.0)
        )
        for number in range(_messages(takes))
    ]
    return _script(script, way, takes, NavigateToPose.Result(distance_traveled=1.2))


def _pick(script: Script, force: float) -> GoalScript:
    seconds = {**dict.fromkeys(STAGES, STAGE_DURATION), **script.get("stages", {})}
    stages = [each for each in STAGES for _ in range(_messages(seconds[each]))]
    work = [
        PickAndPlace.Feedback(
            stage=each,
            percent_complete=100.0 * number / len(stages),
            hand_pose=_pose(0.4, -0.2, 0.8),
            distance_to_object=0.01 * number,
            grasp_force=force,
        )
        for number, each in enumerate(stages)
    ]
    tilted = _pose(0.03 * force, -0.1, 0.75, yaw=0.4)
    tilted.pose.orientation.x, tilted.pose.orientation.y = 0.0123, -0.0456
    result = PickAndPlace.Result(final_object_pose=tilted, max_grasp_force=force)
    return _script(script, work, sum(seconds.values()), result)


def _script(script: Script, feedback: Sequence[Any], takes: float, result: Any) -> GoalScript:
    agreed, stops_after = script.get("stops", (True, 1.0))
    result.error_code, result.error_msg = script.get("code", 0), script.get("said", "")
    before = _messages(script.get("silent_after", takes))
    return GoalScript(
        accepted=script.get("accepted", True),
        after=script.get("answered_after", 0.0),
        feedback=feedback if "silent_for" in script else feedback[:before],
        every=[
            script.get("silent_for", FEEDBACK_PERIOD) if number == before else FEEDBACK_PERIOD
            for number, _ in enumerate(feedback, start=1)
        ],
        ends_after=takes,
        status=getattr(GoalStatus, f"STATUS_{script.get('ends', 'SUCCEEDED')}"),
        result=result,
        cancel=CancelScript(agreed=agreed, ends_after=stops_after),
    )


def _messages(seconds: float) -> int:
    return round(seconds / FEEDBACK_PERIOD)


def _goal(
    object_id: str = "cup",
    x: float = 0.4,
    y: float = -0.1,
    z: float = 0.75,
    force: float = 12.0,
    yaw: float = 0.6,
) -> PickAndPlace.Goal:
    return PickAndPlace.Goal(object_id=object_id, place_pose=_pose(x, y, z, yaw), grasp_force=force)


def _pose(x: float, y: float, z: float, yaw: float = 0.0) -> PoseStamped:
    pose = pose_at(x, y, yaw)
    pose.pose.position.z = z
    return pose
