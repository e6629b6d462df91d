"""Makes films of the robot from recorded messages, which are stored in the notebook."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from geometry_msgs.msg import PoseStamped
from IPython.display import HTML
from nav_msgs.msg import Odometry
from PIL import Image
from sensor_msgs.msg import JointState

from lab.pictures.labels import Mark
from lab.pictures.picture import HEIGHT, WIDTH, as_mujoco, body_to_draw, figure
from robot_sim.humanoid import Humanoid
from robot_sim.views.film import save_frames
from robot_sim.views.view import View
from ros_runtime.cell_notice import notice
from ros_runtime.workarounds.gl_backend import NoOpenGLError

RATE = 12.5  # frames a second
ON_ITS_PLACE = 0.05  # m, from the first place of the pelvis to the last
MOVED = 0.1  # rad, between the lowest and the highest angle of a joint
MAX_DURATION = 60.0  # s; such a film takes about 5 MB in the notebook
DRAWING = "The film is being drawn, which takes some seconds, on a busy machine longer."


@notice(DRAWING)
def film_of_messages(
    odometry: Sequence[tuple[float, Odometry]],
    joints: Sequence[tuple[float, JointState]],
    objects: Mapping[str, Sequence[tuple[float, PoseStamped]]],
    seconds: float,
    *,
    marks: Sequence[Mark],
    robot: str,
    slow_motion: float,
    camera: str,
    file: str | Path | None,
) -> HTML:
    """Film the robot from 0 to `seconds` from messages with their times (s); poses between messages are interpolated.

    The film's alternative text names the marks, and how far the robot has walked or which joint has moved most.

    Raises ValueError when the film would last longer than 60 s, or there is no such camera.
    """
    lasts = seconds * slow_motion
    if not 0 < lasts <= MAX_DURATION:
        raise ValueError(f"the film would last {lasts:g} s; expected more than 0, at most {MAX_DURATION:g}")
    count = max(1, round(lasts * RATE))
    words = f"The robot{''.join(f' and the {name}' for name in objects)} for {seconds:.1f} s"
    if slow_motion != 1.0:
        words += f", slowed down {slow_motion:g} times"
    if marks:
        words += f" ({', '.join(f'{mark.label} at {mark.time:.1f} s' for mark in marks)})"
    words += f"; {_in_the_end(odometry, joints)}"

    body = body_to_draw(robot)

    def postures() -> Iterator[None]:
        return set_postures(body, np.arange(count) / RATE / slow_motion, odometry, joints, objects)

    try:
        view = View(body, WIDTH, HEIGHT, shadows=False)
    except NoOpenGLError as error:
        return HTML(f"<p>{escape(words)}. No film: {escape(str(error))}</p>")
    try:
        view.fit(camera, postures())
        frames = [Image.fromarray(view.picture(camera)) for _ in postures()]
    finally:
        view.close()
    webp = io.BytesIO()
    save_frames(webp, frames, "WEBP", RATE)
    if file is not None:
        Path(file).write_bytes(webp.getvalue())
    return figure(webp.getvalue(), "webp", words, words)


def _in_the_end(
    odometry: Sequence[tuple[float, Odometry]], joints: Sequence[tuple[float, JointState]]
) -> str:
    """Say how far the robot has walked; of a robot that stands on its place, which joint has moved most."""
    begin, end = (odometry[index][1].pose.pose.position for index in (0, -1))
    way = math.dist((begin.x, begin.y), (end.x, end.y))
    angles = np.array([message.position for _, message in joints])
    moved = np.ptp(angles, axis=0)
    if way > ON_ITS_PLACE or moved.max() < MOVED:
        return f"it ends {way:.2f} m from where it began"
    most = int(moved.argmax())
    return f"{joints[0][1].name[most]} begins at {angles[0, most]:.2f} rad and ends at {angles[-1, most]:.2f} rad"


def set_postures(
    body: Humanoid,
    at: np.ndarray,
    odometry: Sequence[tuple[float, Odometry]],
    joints: Sequence[tuple[float, JointState]],
    objects: Mapping[str, Sequence[tuple[float, PoseStamped]]],
) -> Iterator[None]:
    """Set the posture of a humanoid and the poses of its objects to each of these times (s); yield after each time."""
    poses = _interpolated(at, [(t, as_mujoco(message.pose.pose)) for t, message in odometry])
    angles = _interpolated(at, [(t, message.position) for t, message in joints])
    places = [body.model.joint(name).qposadr[0] for name in joints[0][1].name]
    moves = {
        name: _interpolated(at, [(t, as_mujoco(message.pose)) for t, message in messages])
        for name, messages in objects.items()
        if messages
    }
    for frame, (pose, positions) in enumerate(zip(poses, angles, strict=True)):
        body.data.qpos[:7], body.data.qpos[places] = pose, positions
        for name, places_of_it in moves.items():
            body.data.joint(name).qpos[:] = places_of_it[frame]
        mujoco.mj_forward(body.model, body.data)  # which also makes the quaternion a unit again
        yield


def _interpolated(at: np.ndarray, samples: Sequence[tuple[float, Any]]) -> np.ndarray:
    """Interpolate samples at other times; the result has one row for each time."""
    times = [t for t, _ in samples]
    columns = np.array([values for _, values in samples]).T
    return np.stack([np.interp(at, times, column) for column in columns], axis=1)
