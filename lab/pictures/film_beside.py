"""Films recorded walks to a goal beside each other, with the goals' statuses and capture points."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape

import numpy as np
from IPython.display import HTML
from PIL import Image, ImageDraw

from lab.errors import LabError
from lab.pictures.film import DRAWING, MAX_DURATION, RATE, set_postures
from lab.pictures.lettering import font
from lab.pictures.picture import body_to_draw, figure
from lab.pictures.recorded_goal import RecordedGoal
from lab.pictures.recording import Recording
from robot_sim.views.film import save_frames
from robot_sim.views.view import View
from ros_runtime.cell_notice import notice
from ros_runtime.message_constants import RobotMode, name_of
from ros_runtime.workarounds.gl_backend import NoOpenGLError

WIDTH, HEIGHT, ABOVE, BELOW = 330, 330, 30, 66  # px, of a picture, and for the texts above and below it
LEGEND, DOT_RADIUS = 26, 6  # px
LEAD_TIME = 0.4  # s of the film before the goal is sent
GRAVITY = 9.81  # m/s²
SHEET, PALE = "#262626", "#c8c8c8"  # dark in both themes, like the edge of a film
GOAL, CAPTURE_POINT = "#56B4E9", "#F0884A"
STATUS_COLOURS = {"SUCCEEDED": "#5BD6A8", "ABORTED": CAPTURE_POINT, "CANCELED": CAPTURE_POINT}


@notice(DRAWING)
def film_beside(recordings: Mapping[str, Recording], *, camera: str = "side") -> HTML:
    """Film recorded walks to a goal beside each other, each from the moment when its goal was sent.

        lab.film_beside({"at once": one, "after settling": other})

    Each picture shows the goal's status and the robot's mode. Two dots on the floor show the goal and the *capture
    point*, above which the pelvis could come to rest. Without OpenGL you get a description of the film and the reason
    why there is none.

    Raises:
        LabError: a recording has no goal with a pose.
        ValueError: the film would last longer than 60 s, or there is no such camera.
    """
    walks = [_Walk.of(name, recording) for name, recording in recordings.items()]
    seconds = max(walk.seconds for walk in walks)
    if seconds > MAX_DURATION:
        raise ValueError(f"the film would last {seconds:.0f} s; expected at most {MAX_DURATION:g}")
    words = " ".join(walk.in_words() for walk in walks)
    after = np.arange(max(1, round(seconds * RATE))) / RATE
    try:
        columns = [walk.frames(after, camera) for walk in walks]
    except NoOpenGLError as error:
        return HTML(f"<p>{escape(words)} No film: {escape(str(error))}</p>")
    frames = [_beside(pictures) for pictures in zip(*columns, strict=True)]
    webp = io.BytesIO()
    save_frames(webp, frames, "WEBP", RATE, last=1.0)
    return figure(webp.getvalue(), "webp", words, words, width=frames[0].width)


@dataclass(frozen=True)
class _Walk:
    """A recorded walk to a place (x, y in frame odom); times are in s since its recording began."""

    name: str
    recording: Recording
    goal: RecordedGoal
    place: tuple[float, float]
    start: tuple[float, float]

    @classmethod
    def of(cls, name: str, recording: Recording) -> _Walk:
        goal = recording.goal()
        odometry = recording.messages("odom")
        base = min(odometry, key=lambda pair: abs(pair[0] - goal.sent))[1].pose.pose
        place = goal.place(base)
        if place is None:
            raise LabError(f"{name}: the goal's message has no pose, so there is no walk to a place to film")
        return cls(name, recording, goal, place, (base.position.x, base.position.y))

    @property
    def begin(self) -> float:
        return max(0.0, self.goal.sent - LEAD_TIME)

    @property
    def seconds(self) -> float:
        return self.recording.seconds - self.begin

    def frames(self, after: np.ndarray, camera: str) -> list[Image.Image]:
        """Return a picture for each time (s) after the beginning; after the recording's end, repeat the last one."""
        at = np.minimum(self.begin + after, self.recording.seconds)
        body = body_to_draw(self.recording.robot)
        view = View(body, WIDTH, HEIGHT, shadows=False)
        try:
            postures = set_postures(
                body, at, self.recording.messages("odom"), self.recording.messages("joint_states"), {}
            )
            return [self._frame(view, camera, t) for t, _ in zip(at, postures, strict=True)]
        finally:
            view.close()

    def capture_point(self, t: float) -> tuple[float, float]:
        """Return the point on the floor above which the pelvis could come to rest, (x, y) in frame odom."""
        x, y, height, forwards, sideways, heading = (
            float(np.interp(t, *self.recording.values(quantity)))
            for quantity in ("x", "y", "height", "speed", "sideways speed", "heading")
        )
        time_constant = math.sqrt(height / GRAVITY)  # s, of the inverted pendulum
        ahead, aside = forwards * time_constant, sideways * time_constant
        cos, sin = math.cos(heading), math.sin(heading)
        return x + cos * ahead - sin * aside, y + sin * ahead + cos * aside

    def past_the_goal(self, t: float) -> float:
        """Return how far (m) the pelvis is past the goal, along the line from the start; negative before the goal."""
        x, y = (float(np.interp(t, *self.recording.values(quantity))) for quantity in ("x", "y"))
        way = math.dist(self.start, self.place)
        return (
            (x - self.place[0]) * (self.place[0] - self.start[0])
            + (y - self.place[1]) * (self.place[1] - self.start[1])
        ) / way

    def mode_at(self, t: float) -> str:
        first, *others = self.recording.messages("robot_state")
        mode = [first[1].mode, *(state.mode for at, state in others if at <= t)][-1]
        return name_of(RobotMode, mode)

    def in_words(self) -> str:
        at, status = self.goal.statuses[-1] if self.goal.statuses else (self.recording.seconds, "SENT")
        then = self.recording.seconds
        return (
            f"{self.name}: {status} after {at - self.goal.sent:.1f} s, {_where(self.past_the_goal(at))}, "
            f"{self.mode_at(at)}; in the end {_where(self.past_the_goal(then))}, {self.mode_at(then)}."
        )

    def _frame(self, view: View, camera: str, t: float) -> Image.Image:
        image = Image.new("RGB", (WIDTH, ABOVE + HEIGHT + BELOW), SHEET)
        seen = Image.fromarray(view.picture(camera))
        draw = ImageDraw.Draw(seen)
        for (x, y), colour, flat in ((self.place, GOAL, 0.45), (self.capture_point(t), CAPTURE_POINT, 1.0)):
            right, down = view.pixel_of((x, y, 0.0))
            size = DOT_RADIUS / flat
            draw.ellipse(
                (right - size, down - DOT_RADIUS * flat, right + size, down + DOT_RADIUS * flat),
                fill=colour,
                outline="white",
            )
        image.paste(seen, (0, ABOVE))
        draw = ImageDraw.Draw(image)
        draw.text((8, 6), self.name, font=font(15, bold=True), fill="white")
        draw.text((WIDTH - 8, 8), f"{t - self.goal.sent:.1f} s", font=font(13), fill=PALE, anchor="ra")
        status, below = self.goal.status_at(t), ABOVE + HEIGHT
        draw.text((8, below + 6), status, font=font(19, bold=True), fill=STATUS_COLOURS.get(status, PALE))
        draw.text(
            (WIDTH - 8, below + 9), self.mode_at(t), font=font(15, bold=True), fill="white", anchor="ra"
        )
        draw.text((8, below + 38), f"pelvis {_where(self.past_the_goal(t))}", font=font(14), fill="white")
        return image


def _where(past: float) -> str:
    return f"{abs(past):.2f} m {'past' if past > 0 else 'before'} the goal"


def _beside(pictures: tuple[Image.Image, ...]) -> Image.Image:
    width = sum(picture.width for picture in pictures) + 8 * (len(pictures) - 1)
    image = Image.new("RGB", (width, pictures[0].height + LEGEND), SHEET)
    for number, picture in enumerate(pictures):
        image.paste(picture, (number * (WIDTH + 8), 0))
    draw, x, y = ImageDraw.Draw(image), 8, pictures[0].height
    for colour, text in (
        (GOAL, "goal"),
        (CAPTURE_POINT, "capture point: where the pelvis could come to rest"),
    ):
        draw.ellipse((x, y + 6, x + 10, y + 16), fill=colour)
        draw.text((x + 16, y + 2), text, font=font(13), fill="white")
        x += 36 + round(draw.textlength(text, font=font(13)))
    return image
