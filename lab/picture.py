"""A picture of the robot in its present posture."""

from __future__ import annotations

import base64
import io
from functools import cache
from html import escape

import mujoco
from IPython.display import HTML
from nav_msgs.msg import Odometry
from PIL import Image
from sensor_msgs.msg import JointState

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
    take_posture(body, topics.odometry(), topics.latest("joint_states"))
    try:
        pixels = snapshot(body, WIDTH, HEIGHT, camera=camera)
    except NoOpenGLError as error:
        return HTML(f"<p>{escape(words)}. No picture: {escape(str(error))}</p>")
    png = io.BytesIO()
    Image.fromarray(pixels).save(png, "PNG")
    return figure(png.getvalue(), "png", words, words)


def figure(image: bytes, kind: str, words: str, caption: str = "", *, width: int = WIDTH) -> HTML:
    """Embed an image ("png", "webp", "svg+xml") in the notebook, `width` px wide, with an alternative text."""
    data = base64.b64encode(image).decode()
    below = f"<figcaption>{escape(caption)}</figcaption>" if caption else ""
    return HTML(
        f'<figure><img src="data:image/{kind};base64,{data}" width="{width}" alt="{escape(words)}">'
        f"{below}</figure>"
    )


@cache
def _body() -> Humanoid:
    """A humanoid for rendering only: it is never stepped."""
    return Humanoid()


def take_posture(body: Humanoid, odometry: Odometry, joints: JointState) -> None:
    """Set the pose and joints of a humanoid from messages of odom and joint_states."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    body.data.qpos[:7] = p.x, p.y, p.z, q.w, q.x, q.y, q.z  # MuJoCo puts w first
    for name, position in zip(joints.name, joints.position, strict=True):
        body.data.joint(name).qpos[0] = position
    mujoco.mj_forward(body.model, body.data)
