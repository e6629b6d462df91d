"""Films a recorded walk to a point from above, with path, phases, bearing, and the moments that were marked."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from IPython.display import HTML
from PIL import Image, ImageDraw

from lab.errors import LabError
from lab.pictures.figure import BLUE, GREY, VERMILION
from lab.pictures.film import DRAWING, MAX_DURATION, RATE
from lab.pictures.labels import Mark
from lab.pictures.lettering import font
from lab.pictures.picture import figure
from lab.pictures.recorded_goal import RecordedGoal
from lab.pictures.recording import Recording
from robot_sim.views.film import save_frames
from ros_runtime.angles import wrap
from ros_runtime.cell_notice import notice

WIDTH = 600  # px
MIN_HEIGHT, MAX_HEIGHT = 150, 420  # px, of the floor
ABOVE, BELOW = 62, 30  # px, for the texts above and below the floor
OVERSAMPLING = 2  # the floor is drawn at this multiple of its size and scaled down, for smooth lines
MARGIN = 0.4  # m of floor around the path and the goal
WEDGE_RADIUS = 0.45  # m, of the wedge that shows the bearing
FLASH_DURATION, LABEL_DURATION = 0.8, 2.5  # s, of a mark
COLOURS = (BLUE, VERMILION, "#007A5E", "#8A4F7D", GREY)
BODY = ((0.14, 0.0), (0.04, 0.16), (-0.08, 0.16), (-0.08, -0.16), (0.04, -0.16))  # m, from its front


@notice(DRAWING)
def film_from_above(recording: Recording, *, reach: float = 0.0, title: str = "The trip from above") -> HTML:
    """Film the walk to the last goal of a recording from above.

    The colour of the path shows the goal's phase, which is `status` in its feedback. A wedge at the robot shows the
    bearing, the angle from the robot's heading to the goal. A circle around the goal has the radius `reach`, in m.
    Moments that were marked with `recording.mark()` flash.

    Raises:
        LabError: the recording has no goal with a pose whose feedback has a `status`.
        ValueError: the film would last longer than 60 s.
    """
    if recording.seconds > MAX_DURATION:
        raise ValueError(f"the film would last {recording.seconds:.0f} s; expected at most {MAX_DURATION:g}")
    trip = _Trip.of(recording)
    floor = _Floor.around(trip, reach)
    webp = io.BytesIO()
    save_frames(webp, [*floor.frames(trip)], "WEBP", RATE, last=3.0)
    words = f"{title}, {recording.seconds:.1f} s. {trip.in_words()}"
    return figure(webp.getvalue(), "webp", words, title, width=WIDTH)


@dataclass(frozen=True)
class _Trip:
    """The recorded positions and headings at the times of the frames (s), the goal and the marks."""

    at: np.ndarray
    xs: np.ndarray
    ys: np.ndarray
    headings: np.ndarray
    goal: RecordedGoal
    place: tuple[float, float]
    marks: Sequence[Mark]

    @classmethod
    def of(cls, recording: Recording) -> _Trip:
        goal = recording.goal()
        base = recording.messages("odom")[0][1].pose.pose
        place = goal.place(base)
        if place is None or not any(hasattr(message, "status") for _, message in goal.feedback):
            raise LabError(
                "there is no walk to film: the last goal has no pose, or its feedback has no `status`"
            )
        at = np.arange(max(1, round(recording.seconds * RATE))) / RATE
        xs, ys, headings = (np.interp(at, *recording.values(name)) for name in ("x", "y", "heading"))
        return cls(at, xs, ys, headings, goal, place, recording.marks)

    @property
    def phases(self) -> list[tuple[float, str]]:
        """The beginning (s) and the name of each phase."""
        statuses = [(t, feedback.status) for t, feedback in self.goal.feedback]
        return [statuses[0], *(later for earlier, later in pairwise(statuses) if earlier[1] != later[1])]

    @property
    def colours(self) -> dict[str, str]:
        return dict(zip(dict.fromkeys(phase for _, phase in self.phases), COLOURS * 9, strict=False))

    def phase_at(self, t: float) -> str | None:
        message = self.goal.feedback_at(t)
        return None if message is None else message.status

    def distance(self, frame: int) -> float:
        return math.dist((self.xs[frame], self.ys[frame]), self.place)

    def bearing(self, frame: int) -> float:
        """Return the angle from the robot's heading to the goal, in rad; to the left is positive."""
        direction = math.atan2(self.place[1] - self.ys[frame], self.place[0] - self.xs[frame])
        return wrap(direction - self.headings[frame])

    def in_words(self) -> str:
        phases = ", ".join(f"{phase} from {t:.1f} s" for t, phase in self.phases)
        moments = " ".join(f"{mark.time:.1f} s: {mark.label}." for mark in self.marks)
        return (
            f"Phases: {phases}. {moments} In the end {self.goal.status_at(self.at[-1])}, "
            f"{self.distance(-1):.2f} m from the goal."
        )


@dataclass(frozen=True)
class _Floor:
    """The visible part of the floor: its left upper corner (m, frame odom) and its scale."""

    left: float
    upper: float
    scale: float  # px of the drawing per metre
    height: int  # px of the drawing
    reach: float  # m, the radius of the circle around the goal

    @classmethod
    def around(cls, trip: _Trip, reach: float) -> _Floor:
        xs = [trip.xs.min(), trip.xs.max(), trip.place[0] - reach, trip.place[0] + reach]
        ys = [trip.ys.min(), trip.ys.max(), trip.place[1] - reach, trip.place[1] + reach]
        wide, deep = max(xs) - min(xs) + 2 * MARGIN, max(ys) - min(ys) + 2 * MARGIN
        scale = min(WIDTH / wide, MAX_HEIGHT / deep) * OVERSAMPLING
        height = max(MIN_HEIGHT * OVERSAMPLING, round(deep * scale))
        left = (min(xs) + max(xs)) / 2 - WIDTH * OVERSAMPLING / scale / 2
        return cls(left, (min(ys) + max(ys)) / 2 + height / scale / 2, scale, height, reach)

    def frames(self, trip: _Trip) -> list[Image.Image]:
        paper = self._empty(trip)
        path = ImageDraw.Draw(paper)
        shown = []
        for frame, t in enumerate(trip.at):
            here = self._px(trip.xs[frame], trip.ys[frame])
            phase = trip.phase_at(t)
            colour = GREY if phase is None else trip.colours[phase]
            if frame:
                before = self._px(trip.xs[frame - 1], trip.ys[frame - 1])
                path.line((*before, *here), fill=colour, width=3 * OVERSAMPLING)
            shown.append(self._frame(paper.copy(), trip, frame, colour))
        return shown

    def _empty(self, trip: _Trip) -> Image.Image:
        """Draw the floor with a line every half metre, the goal and its circle."""
        paper = Image.new("RGB", (WIDTH * OVERSAMPLING, self.height), "#f7f7f7")
        draw = ImageDraw.Draw(paper)
        for metre in np.arange(math.floor(self.left), self.left + paper.width / self.scale, 0.5):
            draw.line(
                (self._px(metre, 0)[0], 0, self._px(metre, 0)[0], self.height),
                fill="#e2e2e2",
                width=OVERSAMPLING,
            )
        for metre in np.arange(math.floor(self.upper - self.height / self.scale), self.upper, 0.5):
            draw.line(
                (0, self._px(0, metre)[1], paper.width, self._px(0, metre)[1]),
                fill="#e2e2e2",
                width=OVERSAMPLING,
            )
        self._circle(
            draw, self._px(*trip.place), self.reach * self.scale, outline=GREY, width=2 * OVERSAMPLING
        )
        self._circle(draw, self._px(*trip.place), 5 * OVERSAMPLING, fill="black")
        return paper

    def _frame(self, paper: Image.Image, trip: _Trip, frame: int, colour: str) -> Image.Image:
        t, heading, bearing = trip.at[frame], trip.headings[frame], trip.bearing(frame)
        draw = ImageDraw.Draw(paper, "RGBA")
        x, y = trip.xs[frame], trip.ys[frame]
        arc = [heading + bearing * part / 24 for part in range(25)]
        wedge = [
            self._px(x + WEDGE_RADIUS * math.cos(angle), y + WEDGE_RADIUS * math.sin(angle)) for angle in arc
        ]
        draw.polygon([self._px(x, y), *wedge], fill=(*bytes.fromhex(colour[1:]), 70))
        turned = (
            (
                x + math.cos(heading) * a - math.sin(heading) * b,
                y + math.sin(heading) * a + math.cos(heading) * b,
            )
            for a, b in BODY
        )
        draw.polygon([self._px(*corner) for corner in turned], fill=colour, outline="white")
        last = next(
            (mark for mark in reversed(trip.marks) if mark.time <= t < mark.time + LABEL_DURATION), None
        )
        if last is not None and t < last.time + FLASH_DURATION:
            size = (0.2 + 0.5 * (t - last.time) / FLASH_DURATION) * self.scale
            self._circle(draw, self._px(x, y), size, outline=VERMILION, width=4 * OVERSAMPLING)
        return self._with_texts(paper.resize((WIDTH, self.height // OVERSAMPLING)), trip, frame, last)

    def _with_texts(self, floor: Image.Image, trip: _Trip, frame: int, last: Mark | None) -> Image.Image:
        image = Image.new("RGB", (WIDTH, ABOVE + floor.height + BELOW), "white")
        image.paste(floor, (0, ABOVE))
        draw, x, t = ImageDraw.Draw(image), 10, trip.at[frame]
        for phase, colour in trip.colours.items():
            is_now = phase == trip.phase_at(t)
            draw.text((x, 8), phase, font=font(15, bold=is_now), fill=colour if is_now else GREY)
            x += 22 + round(draw.textlength(phase, font=font(15, bold=True)))
        numbers = (
            f"{trip.distance(frame):.2f} m to the goal, bearing {math.degrees(trip.bearing(frame)):+.0f}°"
        )
        draw.text((10, 34), numbers, font=font(14), fill="black")
        draw.text((WIDTH - 10, 8), f"{t:.1f} s", font=font(14), fill=GREY, anchor="ra")
        draw.text(
            (WIDTH - 10, 34), trip.goal.status_at(t), font=font(14, bold=True), fill="black", anchor="ra"
        )
        below = ABOVE + floor.height
        if last is not None:
            draw.text((10, below + 6), last.label, font=font(14, bold=True), fill=VERMILION)
        half = round(self.scale / OVERSAMPLING / 2)
        draw.line((WIDTH - 10 - half, below + 8, WIDTH - 10, below + 8), fill="black", width=2)
        draw.text((WIDTH - 10, below + 11), "0.5 m", font=font(12), fill="black", anchor="ra")
        return image

    def _px(self, x: float, y: float) -> tuple[float, float]:
        return (x - self.left) * self.scale, (self.upper - y) * self.scale

    @staticmethod
    def _circle(
        draw: ImageDraw.ImageDraw, middle: tuple[float, float], radius: float, **style: object
    ) -> None:
        x, y = middle
        draw.ellipse((x - radius, y - radius, x + radius, y + radius), **style)  # type: ignore[arg-type]
