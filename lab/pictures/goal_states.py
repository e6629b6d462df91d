"""Draws the state machine of a goal, in which the states of the last goal light up one after the other."""

from __future__ import annotations

from itertools import pairwise
from zlib import crc32

from IPython.display import HTML

from lab.client.interaction_log import log
from lab.errors import LabError
from lab.pictures.figure import BLUE, GREY
from lab.pictures.picture import hideable
from lab.pictures.recorded_goal import RecordedGoal, last_goal
from ros_runtime.drawing.svg import svg
from ros_runtime.message_constants import GoalStatus
from ros_runtime.record.client_events import (
    FeedbackReceived,
    GoalAnswered,
    GoalSent,
    ResultReceived,
    StatusSeen,
)

WIDTH, HEIGHT = 700, 286  # px
BOX = (128, 44)  # px
LIT_COLOUR = "#D6E8F5"
PLACES = {  # the middle of each state's box, px
    "REJECTED": (84, 234),
    "ACCEPTED": (236, 90),
    "EXECUTING": (404, 90),
    "CANCELING": (404, 234),
    "SUCCEEDED": (620, 76),
    "ABORTED": (620, 155),
    "CANCELED": (620, 234),
}
SENT = (84, 90)
CHANGES = (
    ("SENT", "ACCEPTED"),
    ("SENT", "REJECTED"),
    ("ACCEPTED", "EXECUTING"),
    ("ACCEPTED", "CANCELING"),
    ("EXECUTING", "CANCELING"),
    ("EXECUTING", "SUCCEEDED"),
    ("EXECUTING", "ABORTED"),
    ("CANCELING", "SUCCEEDED"),
    ("CANCELING", "ABORTED"),
    ("CANCELING", "CANCELED"),
)
CAUSES = {  # what makes a goal change its state, with the middle of the text, px
    "succeed()": (512, 72),
    "abort()": (486, 134),
    "cancel accepted": (458, 162),
    "canceled()": (508, 252),
}
HOLD_DURATION = 2.0  # s that the last state stays lit before the animation begins again


def draw_goal_states(title: str = "The states of the last goal") -> HTML:
    """Draw the states that a goal can have; the states of the last goal light up one by one, at the speed of the run.

    On paper, and for readers who have turned off animations, all of them are lit, with their times.

    Raises LabError when no goal was sent yet.
    """
    kinds = (GoalSent, GoalAnswered, StatusSeen, FeedbackReceived, ResultReceived)
    goal = last_goal(event for kind in kinds for event in log.all(kind))
    if goal is None:
        raise LabError("there is no goal to draw yet: use lab.send_goal() first")
    times = {"SENT": 0.0} | {status: at - goal.sent for status, at in _reached(goal)}
    parts = [_style(times, key := f"goal{crc32(repr((title, times)).encode()):x}")]
    parts += [_arrow(change, times, key) for change in CHANGES]
    parts += [
        f'<text x="{x}" y="{y}" text-anchor="middle">{cause}</text>' for cause, (x, y) in CAUSES.items()
    ]
    parts += [_box(status, times, key) for status in ("SENT", *PLACES)]
    words = ", then ".join(f"{status} at {at:.2f} s" for status, at in times.items())
    drawing = svg(parts, width=WIDTH, height=HEIGHT, title=title, words=f"{title}: {words}.")
    return HTML(hideable(drawing))


def _reached(goal: RecordedGoal) -> list[tuple[str, float]]:
    """Return the goal's states in order; EXECUTING is added if it was too short for the status topic."""
    reached = [(status, at) for at, status in goal.statuses]
    names = [status for status, _ in reached]
    if "ACCEPTED" in names and "EXECUTING" not in names and names[-1] in ("SUCCEEDED", "ABORTED"):
        reached.insert(1, ("EXECUTING", reached[1][1]))
    return reached


def _style(times: dict[str, float], key: str) -> str:
    """Return the CSS animation of each state, which is dim until its time and lit after it."""
    whole = max(times.values()) + HOLD_DURATION
    rules = [
        f"@keyframes {key}-{status} {{ 0%, {100 * at / whole:.2f}% {{ opacity: 0 }} "
        f"{100 * at / whole + 0.01:.2f}%, 100% {{ opacity: 1 }} }}\n"
        f".{key}-{status} {{ animation: {key}-{status} {whole:.2f}s infinite }}"
        for status, at in times.items()
        if at > 0
    ]
    still = f"@media (prefers-reduced-motion: reduce) {{ [class^={key}] {{ animation: none !important }} }}"
    return "<style>" + "\n".join([*rules, still]) + "</style>"


def _box(status: str, times: dict[str, float], key: str) -> str:
    (x, y), (width, height) = PLACES.get(status, SENT), BOX
    label = "sent" if status == "SENT" else status
    number = f"{GoalStatus[status].value}  " if status in GoalStatus.__members__ else ""
    frame = f'<rect x="{x - width / 2}" y="{y - height / 2}" width="{width}" height="{height}" rx="8"'
    text = f'<text x="{x}" y="{y + (-2 if status in times else 5)}" text-anchor="middle"'
    dim = f'{frame} fill="white" stroke="{GREY}"/>{text} fill="{GREY}">{number}{label}</text>'
    if status not in times:
        return dim
    return (
        f'{dim}<g class="{key}-{status}">{frame} fill="{LIT_COLOUR}" stroke="{BLUE}" stroke-width="2.5"/>'
        f'{text} font-weight="bold">{number}{label}</text>'
        f'<text x="{x}" y="{y + 15}" text-anchor="middle" font-size="12">{times[status]:.2f} s</text></g>'
    )


def _arrow(change: tuple[str, str], times: dict[str, float], key: str) -> str:
    """Draw a change of state; if the goal made it, the arrow turns blue together with the state that it leads to."""
    before, after = change
    line = _between(PLACES.get(before, SENT), PLACES[after])
    dim = _line(line, GREY, 1.2)
    if change not in pairwise(times):
        return dim
    return f'{dim}<g class="{key}-{after}">{_line(line, BLUE, 2.5)}</g>'


def _between(start: tuple[int, int], end: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return a line from one box to another: sideways, or down if the boxes are in one column."""
    (x1, y1), (x2, y2) = start, end
    if x1 == x2:
        return x1, y1 + BOX[1] / 2, x2, y2 - BOX[1] / 2 - 7
    return x1 + BOX[0] / 2, y1, x2 - BOX[0] / 2 - 7, y2


def _line(line: tuple[float, float, float, float], colour: str, width: float) -> str:
    x1, y1, x2, y2 = line
    dx, dy = x2 - x1, y2 - y1
    length = (dx * dx + dy * dy) ** 0.5
    ux, uy = dx / length, dy / length
    tip = f"{x2 + 7 * ux:.1f},{y2 + 7 * uy:.1f} {x2 - 4 * uy:.1f},{y2 + 4 * ux:.1f} {x2 + 4 * uy:.1f},{y2 - 4 * ux:.1f}"
    return (
        f'<path d="M{x1} {y1} L{x2} {y2}" stroke="{colour}" stroke-width="{width}" fill="none"/>'
        f'<polygon points="{tip}" fill="{colour}"/>'
    )
