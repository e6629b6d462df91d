"""Plots on the pages of a class, each an SVG with a text alternative.

They show the scores as bars and, for a run, the robot's speed over time with the events of its goals, and its path.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from ros_runtime.drawing.svg import escape
from ros_runtime.message_constants import GoalStatus, name_of

# Margins around the panel, in inches; they are fixed, because measuring the texts is slow.
LEFT, RIGHT, BELOW, ABOVE = 0.7, 0.2, 0.55, 0.3
CURVE_COLOUR, EVENT_COLOUR, FEEDBACK_COLOUR = "#1f5fa8", "#b34700", "#2c7a3f"
_STYLE = {"svg.fonttype": "none", "text.parse_math": False, "font.size": 9, "axes.edgecolor": "#999999"}
_NO_METADATA = dict.fromkeys(("Date", "Creator", "Format", "Type"))
MIN_DRAWN_MOTION = 0.1  # m; a standing robot sways less
MIN_AXIS_SPEED = 0.2  # m/s; the speed axis reaches at least this value
MAX_EVENTS = 12
ROW_HEIGHT = 11.0  # pt, of an event's label above the panel
# m from the origin; farther goals are not drawn, because the path would be too small to see.
MAX_GOAL_DISTANCE = 20.0


class Plot:
    """One panel of a drawing; `svg` is set when the `with` block of `plotted` ends."""

    def __init__(self, width: float, height: float, above: float) -> None:
        self.figure = Figure(figsize=(width, height))
        self.axes: Axes = self.figure.add_axes(
            (LEFT / width, BELOW / height, 1.0 - (LEFT + RIGHT) / width, 1.0 - (above + BELOW) / height)
        )
        self.svg = ""


@contextmanager
def plotted(title: str, words: str, *, width: float, height: float, pad: float = 6.0) -> Iterator[Plot]:
    """Draw a plot in a `with` block; the same plot has the same bytes.

    Args:
        title: the title above the panel.
        words: the text alternative.
        width: width of the drawing, in inches.
        height: height of the drawing, in inches.
        pad: distance between title and panel, in pt.
    """
    with matplotlib.rc_context({**_STYLE, "svg.hashsalt": f"{title} {words}"}):
        plot = Plot(width, height, ABOVE + pad / 72)
        plot.axes.set_title(title, loc="left", fontweight="bold", pad=pad)
        yield plot
        page = io.StringIO()
        plot.figure.savefig(page, format="svg", metadata=_NO_METADATA)
    # A page has several drawings, whose ids must differ.
    drawn = re.sub(r'<g id="[^"]*">', "<g>", page.getvalue())
    box = re.search(r'viewBox="[^"]*"', drawn)
    assert box
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" {box[0]} '
        f'width="{96 * width:.0f}" role="img">\n<title>{escape(title)}</title>\n<desc>{escape(words)}</desc>'
    )
    plot.svg = re.sub(r"^.*?<svg\b[^>]*>", lambda _: head, drawn, count=1, flags=re.DOTALL)


def bars_svg(numbers: Mapping[str, int], *, title: str, across: str, up: str) -> str:
    """Draw a bar for each label, from left to right; `across` and `up` are the titles of the axes."""
    said = ", ".join(f"{label}: {number}" for label, number in numbers.items() if number)
    words = f"{up} by {across}: {said or 'none'}."
    with plotted(title, words, width=1.0 + 0.55 * len(numbers), height=2.3) as plot:
        bars = plot.axes.bar(list(numbers), list(numbers.values()), color=CURVE_COLOUR)
        plot.axes.bar_label(bars, [str(number or "") for number in numbers.values()])
        plot.axes.margins(y=0.2)
        plot.axes.set(xlabel=across, ylabel=up)
        plot.axes.yaxis.set_major_locator(MaxNLocator(4, integer=True))
    return plot.svg


def motion_svgs(transcript: Transcript, title: str) -> list[str]:
    """Draw speed over time and the path from above; no drawing if the robot did not move."""
    truth = transcript.ground_truth
    if not truth or math.dist(*_corners(transcript)) < MIN_DRAWN_MOTION:
        return []
    return [
        _speed_svg(transcript, f"Speed of the robot: {title}"),
        _path_svg(transcript, f"Path of the robot, from above: {title}"),
    ]


def _speed_svg(transcript: Transcript, title: str) -> str:
    times = [robot.t for robot in transcript.ground_truth]
    speeds = [robot.speed for robot in transcript.ground_truth]
    moments = list(_moments(transcript))[:MAX_EVENTS]
    feedback = [event.t for event in transcript.events if isinstance(event, ev.FeedbackReceived)]
    said = [
        f"speed, m/s: {speeds[0]:.2f} at first, {speeds[-1]:.2f} at last, {max(speeds):.2f} at most; "
        f"time, s: {times[0]:.2f} to {times[-1]:.2f}.",
        *(f"{label}: at {t:.2f}." for label, t in moments),
    ]
    if feedback:
        said.append(f"{len(feedback)} feedback messages from {feedback[0]:.2f} to {feedback[-1]:.2f}.")
    above = ROW_HEIGHT * len(moments)
    with plotted(title, " ".join(said), width=8.0, height=2.6 + above / 72, pad=6.0 + above) as plot:
        plot.axes.plot(times, speeds, color=CURVE_COLOUR)
        plot.axes.set_ylim(0.0, max(MIN_AXIS_SPEED, 1.1 * max(speeds)))
        plot.axes.plot(feedback, [0.0] * len(feedback), "|", color=FEEDBACK_COLOUR, markersize=14)
        plot.axes.set(xlabel="time, s" + "; green: feedback messages" * bool(feedback), ylabel="speed, m/s")
        for row, (label, t) in enumerate(sorted(moments, key=lambda moment: -moment[1])):
            plot.axes.axvline(t, color=EVENT_COLOUR, linestyle="--", linewidth=1)
            is_late = t > (times[0] + times[-1]) / 2
            plot.axes.annotate(
                label,
                (t, 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(-3 if is_late else 3, 4 + ROW_HEIGHT * row),
                textcoords="offset points",
                ha="right" if is_late else "left",
                color=EVENT_COLOUR,
            )
    return plot.svg


def _path_svg(transcript: Transcript, title: str) -> str:
    truth = transcript.ground_truth
    places = [
        ("start", truth[0].x, truth[0].y),
        *_goal_places(transcript),
        ("end", truth[-1].x, truth[-1].y),
    ]
    words = " ".join(f"{label}: at {x:.2f}, {y:.2f}." for label, x, y in places)
    with plotted(title, f"x and y in odom, m. {words}", width=6.0, height=4.0) as plot:
        plot.axes.plot([robot.x for robot in truth], [robot.y for robot in truth], color=CURVE_COLOUR)
        plot.axes.set_aspect("equal", adjustable="datalim")
        plot.axes.margins(0.15)
        plot.axes.set(xlabel="x in odom, m", ylabel="y in odom, m")
        middle = sum(plot.axes.get_xlim()) / 2
        for number, (label, x, y) in enumerate(places):
            plot.axes.plot(x, y, "o", color=EVENT_COLOUR)
            # Labels are above and below in turn, because neighbours are often close to each other.
            offset = (-6 if x > middle else 6, -13 if number % 2 else 6)
            side = "right" if x > middle else "left"
            plot.axes.annotate(label, (x, y), offset, textcoords="offset points", ha=side, color=EVENT_COLOUR)
    return plot.svg


def _corners(transcript: Transcript) -> tuple[tuple[float, float], tuple[float, float]]:
    xs = [robot.x for robot in transcript.ground_truth]
    ys = [robot.y for robot in transcript.ground_truth]
    return (min(xs), min(ys)), (max(xs), max(ys))


def _moments(transcript: Transcript) -> Iterator[tuple[str, float]]:
    """Yield a label for each event of goals and robot, with the event's time (s)."""
    for event in transcript.events:
        match event:
            case ev.GoalSent(t=t, goal=goal):
                yield f"goal “{goal}”", t
            case ev.CancelSent(t=t, goal=goal):
                yield f"cancel “{goal}”" if goal else "cancel every goal", t
            case ev.ResultReceived(t=t, goal=goal, status=status):
                yield f"“{goal}” ends {name_of(GoalStatus, status)}", t
            case ev.RobotCommanded(t=t, verb=verb):
                yield f"the grader: {verb}", t


def _goal_places(transcript: Transcript) -> Iterator[tuple[str, float, float]]:
    """Yield the label and the target (x, y in m) of each goal that has a pose."""
    for sent in transcript.all(ev.GoalSent)[:MAX_EVENTS]:
        stamped = getattr(sent.request, "target_pose", None) or getattr(sent.request, "pose", None)
        position = getattr(getattr(stamped, "pose", None), "position", None)
        if position is not None and math.hypot(position.x, position.y) < MAX_GOAL_DISTANCE:  # False for NaN
            yield f"goal “{sent.goal}”", position.x, position.y
