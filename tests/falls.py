"""The record of an arena in which the robot falls during a goal, made by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from autograder.authoring.checks import Check, Scenario, check
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.exercise import Exercise
from autograder.engine.judging import verdict_on
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.recording.recorder import Recorder
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from records import robot
from robot_sim.humanoid import Humanoid
from robot_sim.ros.posture import PostureReader

WALK = Scenario("walk")
PUSH = Scenario("push_it", namespace="/lab_7/robot")
FELL_AT = 1.5  # s, when the check fails
FALL = 1.0  # s, when the motors go off


@check(points=1, on=WALK)
def accepts(run: Transcript) -> None:
    """The goal is accepted"""


@check(points=2, on=WALK, needs=accepts)
def stays_up(run: Transcript) -> None:
    """The robot stays upright"""
    raise Failure(expected="a robot that stands", observed="a fall", help="Keep the motors on.", at=FELL_AT)


@check(points=3, on=PUSH)
def secret(run: Transcript) -> None:
    """Nobody may know of this one"""


def exercise(*checks: Check) -> Exercise:
    return Exercise("walk_to", Path("walk_to"), checks or (accepts, stays_up))


def simulated(
    scene: str = "flat", seconds: float = 2.0
) -> tuple[list[ev.BodyDescribed | ev.PostureTruth], dict[float, np.ndarray]]:
    """A robot whose motors go off: its postures at 25 Hz, and the simulator's qpos at the same times."""
    humanoid = Humanoid(scene)
    reader = PostureReader(humanoid)
    told: list[Any] = [reader.description]
    places = {}
    for frame in range(round(seconds * 25)):
        t = frame / 25
        while humanoid.time < t - humanoid.timestep / 2:
            humanoid.step()
        if humanoid.motors_enabled and t >= FALL:
            humanoid.set_motor_power(False)
        told.append(_at(reader.read(), t))
        places[t] = humanoid.data.qpos.copy()
    return [_at(told[0], 0.0), *told[1:]], places


def _at(event: Any, t: float) -> Any:
    return type(event)(**{**vars(event), "t": t})


def walk(*more: Any, postures: Any = (), until: float = 2.0) -> Transcript:
    goal = WalkTo.Goal(max_velocity=0.3)
    goal.target_pose.header.frame_id = "odom"
    goal.target_pose.pose.position.x = 0.75
    return Transcript.from_events(
        "walk",
        {"x": 0.75},
        [
            ev.NodeStarted(t=0.0),
            ev.GoalSent(t=0.2, goal="first", action="walk_to", request=goal),
            ev.GoalAnswered(t=0.25, goal="first", accepted=True),
            ev.StatusSeen(t=0.3, goal="first", status=2),
            ev.FeedbackReceived(t=0.4, goal="first", feedback=WalkTo.Feedback(distance_remaining=0.5)),
            ev.NodeOutput(t=0.5, stream="stderr", text="[WARN] [17.2] [walker]: slow"),
            ev.ResultReceived(t=1.9, goal="first", status=6, result=WalkTo.Result(error_code=1)),
            robot(0.1),
            robot(1.2, mode=RobotState.FALLEN),
            *postures,
            *more,
            ev.ScenarioEnded(t=until),
        ],
    )


def judged(one: Check, *runs: Transcript) -> CheckVerdict:
    try:
        one.run(runs)
    except Failure as failure:
        return verdict_on(
            one,
            "failed",
            expected=failure.expected,
            observed=failure.observed,
            help=failure.help,
            robot_time=failure.at,
        )
    return verdict_on(one, "passed", points=one.points)


def recordings(run: Transcript) -> dict[str, bytes]:
    """The recordings of a submission whose robot falls in the scenario "walk"."""
    recorder = Recorder(exercise(), for_students=True)
    verdicts = [judged(accepts, run), judged(stays_up, run)]
    for verdict in verdicts:
        recorder.add(verdict, [run])
    return dict(recorder.files(Grade("walk_to", "zoe", "namespaces", verdicts, seed=4)))


def recorded_fall(folder: Path, scene: str = "flat") -> Path:
    """The file of that recording."""
    path = folder / "walk.mcap"
    path.write_bytes(recordings(walk(postures=simulated(scene)[0]))["walk.mcap"])
    return path
