"""Draws the robot in its current posture, with the objects around it."""

from __future__ import annotations

import base64
import io
from functools import cache
from html import escape

import mujoco
from geometry_msgs.msg import Pose
from IPython.display import HTML
from nav_msgs.msg import Odometry
from PIL import Image
from sensor_msgs.msg import JointState

from lab.client import topics
from robot_sim.humanoid import Humanoid
from robot_sim.views.view import snapshot
from ros_runtime.drawing.svg import CLASS, DARK_IN_JUPYTERLAB
from ros_runtime.workarounds.gl_backend import NoOpenGLError

WIDTH, HEIGHT = 480, 360  # px


def show_robot(camera: str = "track") -> HTML:
    """Draw the robot from its messages on odom and joint_states; `camera` is "track", "side" or "front".

    Without OpenGL you get the caption of the picture and the reason why there is none.
    """
    words = f"The robot: {topics.whereabouts()}"
    body = _body(topics.scene(), topics.robot())
    set_current_posture(body)
    try:
        pixels = snapshot(body, WIDTH, HEIGHT, camera=camera)
    except NoOpenGLError as error:
        return HTML(f"<p>{escape(words)}. No picture: {escape(str(error))}</p>")
    png = io.BytesIO()
    Image.fromarray(pixels).save(png, "PNG")
    return figure(png.getvalue(), "png", words, words)


def figure(content: bytes, kind: str, words: str, caption: str = "", *, width: int = WIDTH) -> HTML:
    """Embed an image of a `kind` ("png", "webp", "svg+xml") in the notebook; `words` is its alternative text."""
    data = base64.b64encode(content).decode()
    below = f"<figcaption>{escape(caption)}</figcaption>" if caption else ""
    image = f'src="data:image/{kind};base64,{data}" width="{width}" alt="{escape(words)}"'
    if kind == "svg+xml":
        return HTML(f'<figure><img {image} class="{CLASS}">{below}</figure>{DARK_IN_JUPYTERLAB}')
    shown = f"<figure><img {image}>{below}</figure>"
    return HTML(hideable(shown) if kind == "webp" else shown)


def hideable(film: str) -> str:
    """Return the HTML of a film that repeats, with a control to hide it."""
    return f"<details open><summary>Film</summary>{film}</details>"


def body_to_draw(robot: str = "") -> Humanoid:
    """Make a robot with this name ("": like the one that was started), which is only drawn, never simulated."""
    return Humanoid(topics.scene(), robot=robot or topics.robot())


@cache
def _body(scene: str, robot: str) -> Humanoid:
    return Humanoid(scene, robot=robot)


def set_current_posture(body: Humanoid) -> None:
    """Set the pose and joints of a humanoid, and the poses of its objects, from the last messages.

    Raises NoRobotError when no messages arrive.
    """
    odometry: Odometry = topics.odometry()
    joints: JointState = topics.latest("joint_states")
    body.data.qpos[:7] = as_mujoco(odometry.pose.pose)
    for name, position in zip(joints.name, joints.position, strict=True):
        body.data.joint(name).qpos[0] = position
    for name, message in topics.object_poses().items():
        if name in body.object_poses():
            body.data.joint(name).qpos[:] = as_mujoco(message.pose)
    mujoco.mj_forward(body.model, body.data)


def as_mujoco(pose: Pose) -> tuple[float, ...]:
    """Return position and orientation in MuJoCo's order, which has w before x, y, z."""
    p, q = pose.position, pose.orientation
    return p.x, p.y, p.z, q.w, q.x, q.y, q.z
