"""A picture of the robot in its present posture."""

from __future__ import annotations

import base64
import io
from functools import cache
from html import escape

import mujoco
from IPython.display import HTML
from PIL import Image

from lab import topics
from robot_sim.humanoid import Humanoid
from robot_sim.views.view import snapshot
from ros_runtime.workarounds.gl_backend import NoOpenGLError

WIDTH, HEIGHT = 480, 360  # px


def show_robot(camera: str = "track") -> HTML:
    """Draw the robot from its own messages, odom and joint_states; camera "track", "side" or "front".

    Without OpenGL you get the caption of the picture and the reason why there is none.
    """
    words = f"The robot: {topics.mode()} at {topics.pose()}"
    body = _body()
    take_posture(body)
    try:
        pixels = snapshot(body, WIDTH, HEIGHT, camera=camera)
    except NoOpenGLError as error:
        return HTML(f"<p>{escape(words)}. No picture: {escape(str(error))}</p>")
    png = io.BytesIO()
    Image.fromarray(pixels).save(png, "PNG")
    return figure(png.getvalue(), "png", words, words)


def figure(image: bytes, kind: str, words: str, caption: str) -> HTML:
    """Embed an image of that kind ("png", "webp") in the notebook, with an alternative text and a caption."""
    data = base64.b64encode(image).decode()
    return HTML(
        f'<figure><img src="data:image/{kind};base64,{data}" width="{WIDTH}" alt="{escape(words)}">'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )


@cache
def _body() -> Humanoid:
    """A humanoid for rendering only: it is never stepped."""
    return Humanoid()


def take_posture(body: Humanoid) -> None:
    """Set the pose and joints of a humanoid from the robot's last odom and joint_states."""
    pose, joints = topics.odometry().pose.pose, topics.latest("joint_states")
    p, q = pose.position, pose.orientation
    body.data.qpos[:7] = p.x, p.y, p.z, q.w, q.x, q.y, q.z  # MuJoCo puts w first
    for name, position in zip(joints.name, joints.position, strict=True):
        body.data.joint(name).qpos[0] = position
    mujoco.mj_forward(body.model, body.data)
