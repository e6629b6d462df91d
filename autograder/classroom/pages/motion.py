"""What the robot did in a transcript, as plots: how fast it was, with the moments of the goal, and where it went."""

from __future__ import annotations

import math
from collections.abc import Iterator

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from ros_runtime.drawing.line_plot import Flag, Plot, plot_svg
from ros_runtime.message_constants import GoalStatus, name_of

LEAST_MOTION = 0.1  # m; a robot that stands sways by less
MOST_FLAGS = 12
FARTHEST = 20.0  # m from the origin, of a goal on a map where the way is still to be seen


def motion_svgs(transcript: Transcript, title: str) -> list[str]:
    """Draw speed over time and the path from above; nothing of a robot that stayed where it was."""
    truth = transcript.ground_truth
    if not truth or math.dist(*_corners(transcript)) < LEAST_MOTION:
        return []
    speed = Plot(
        f"How fast the robot was: {title}",
        "time, s",
        "speed, m/s",
        [(robot.t, robot.speed) for robot in truth],
        flags=list(_moments(transcript))[:MOST_FLAGS],
        ticks=[event.t for event in transcript.events if isinstance(event, ev.FeedbackReceived)],
        ticks_are="feedback messages",
        least=0.2,
    )
    first, last = truth[0], truth[-1]
    path = Plot(
        f"Where the robot went, from above: {title}",
        "x in odom, m",
        "y in odom, m",
        [(robot.x, robot.y) for robot in truth],
        flags=[
            Flag("start", first.x, first.y),
            *_goal_places(transcript),
            Flag("end", last.x, last.y),
        ],
        equal=True,
        least=0.5,
    )
    return [plot_svg(speed), plot_svg(path, width=560, height=340)]


def _corners(transcript: Transcript) -> tuple[tuple[float, float], tuple[float, float]]:
    xs = [robot.x for robot in transcript.ground_truth]
    ys = [robot.y for robot in transcript.ground_truth]
    return (min(xs), min(ys)), (max(xs), max(ys))


def _moments(transcript: Transcript) -> Iterator[Flag]:
    for event in transcript.events:
        match event:
            case ev.GoalSent(t=t, goal=goal):
                yield Flag(f"goal “{goal}”", t)
            case ev.CancelSent(t=t, goal=goal):
                yield Flag(f"cancel “{goal}”" if goal else "cancel every goal", t)
            case ev.ResultReceived(t=t, goal=goal, status=status):
                yield Flag(f"“{goal}” ends {name_of(GoalStatus, status)}", t)
            case ev.RobotCommanded(t=t, verb=verb):
                yield Flag(f"the grader: {verb}", t)


def _goal_places(transcript: Transcript) -> Iterator[Flag]:
    """Where the goals that name a pose on the ground want the robot."""
    for sent in transcript.all(ev.GoalSent)[:MOST_FLAGS]:
        stamped = getattr(sent.request, "target_pose", None) or getattr(sent.request, "pose", None)
        position = getattr(getattr(stamped, "pose", None), "position", None)
        if position is not None and math.hypot(position.x, position.y) < FARTHEST:  # NaN is not
            yield Flag(f"goal “{sent.goal}”", position.x, position.y)
