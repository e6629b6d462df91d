"""Pictures of the robot, drawn off-screen."""

from __future__ import annotations

import copy
import math
from collections.abc import Iterable

import mujoco
import numpy as np

from robot_sim.humanoid import Humanoid
from ros_runtime.workarounds.gl_backend import open_context

FILLED = (
    0.95  # share of a picture's width or height that a fitted view fills, the middle being the centre of mass
)


def snapshot(humanoid: Humanoid, width: int = 640, height: int = 480, *, camera: str = "track") -> np.ndarray:
    """Return one RGB picture (height, width, 3), uint8, of the robot's present state.

    Args:
        humanoid: the robot to draw.
        width: of the picture, px.
        height: of the picture, px.
        camera: "track" (from the front right, follows the robot), "side", "front" or "head_camera".

    Raises:
        ValueError: the model has no such camera; the message lists its cameras.
        NoOpenGLError: this machine cannot draw.
    """
    view = View(humanoid, width, height)
    try:
        return view.picture(camera)
    finally:
        view.close()


class View:
    """A renderer of one robot; call `close()` at the end, because an OpenGL context outlives its Python object.

    Args:
        humanoid: the robot to draw.
        width, height: of the pictures, px.
        shadows: whether to draw shadows, which take most of the time without a graphics card.

    Raises:
        NoOpenGLError: this machine cannot draw.
    """

    def __init__(
        self, humanoid: Humanoid, width: int = 640, height: int = 480, *, shadows: bool = True
    ) -> None:
        self._data = humanoid.data
        self._model = copy.copy(humanoid.model)
        self._model.vis.global_.offwidth, self._model.vis.global_.offheight = width, height
        self._rectangle = mujoco.MjrRect(0, 0, width, height)
        self._scene = mujoco.MjvScene(self._model, maxgeom=1000)
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        self._option = mujoco.MjvOption()
        self._gl = open_context(width, height)
        self._gl.make_current()
        self._renderer = mujoco.MjrContext(self._model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._renderer)

    def picture(self, camera: str = "track") -> np.ndarray:
        """Draw the robot's present state through one of the model's cameras: RGB (height, width, 3), uint8.

        Raises:
            ValueError: the model has no such camera; the message lists its cameras.
        """
        self._gl.make_current()
        self._update_scene(self._camera(camera))
        mujoco.mjr_render(self._rectangle, self._scene, self._renderer)
        pixels = np.empty((self._rectangle.height, self._rectangle.width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, self._rectangle, self._renderer)
        return pixels[::-1].copy()  # OpenGL's first row is the lowest

    def fit(self, camera: str, postures: Iterable[object]) -> None:
        """Narrow a camera's view until the bodies that move fill it; each step of `postures` sets one posture."""
        seen_from = self._camera(camera)
        moving = self._model.body_weldid[self._model.geom_bodyid] > 0
        filled = 0.0
        for _ in postures:
            self._update_scene(seen_from)
            right, height, scale = self._from_middle(self._data.geom_xpos[moving])
            for offset, half in ((right, self._rectangle.width / 2), (height, self._rectangle.height / 2)):
                filled = max(filled, ((abs(offset) + self._model.geom_rbound[moving]) * scale).max() / half)
        if 0 < filled < FILLED:
            narrowed = (
                math.tan(math.radians(self._model.cam_fovy[seen_from.fixedcamid]) / 2) * filled / FILLED
            )
            self._model.cam_fovy[seen_from.fixedcamid] = math.degrees(2 * math.atan(narrowed))

    def pixel_of(self, point: tuple[float, float, float]) -> tuple[float, float]:
        """Return the position of a point of the world (m) in the last picture, px from its left and upper edge."""
        right, height, scale = self._from_middle(np.asarray(point))
        return self._rectangle.width / 2 + right * scale, self._rectangle.height / 2 - height * scale

    def close(self) -> None:
        """Free the OpenGL context."""
        self._gl.make_current()
        self._renderer.free()
        self._gl.free()

    def _update_scene(self, camera: mujoco.MjvCamera) -> None:
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self._model, self._data, self._option, None, camera, everything, self._scene)

    def _from_middle(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return how far (m) points (…, 3) are right of and above the camera's axis, and the scale there (px/m)."""
        eyes = self._scene.camera  # the left and the right one
        position, forward, up = (
            np.mean([getattr(eye, name) for eye in eyes], axis=0) for name in ("pos", "forward", "up")
        )
        way = points - position
        scale = eyes[0].frustum_near / (way @ forward) * self._rectangle.height / 2 / eyes[0].frustum_top
        return way @ np.cross(forward, up), way @ up, scale

    def _camera(self, name: str) -> mujoco.MjvCamera:
        names = [self._model.camera(index).name for index in range(self._model.ncam)]
        if name not in names:
            raise ValueError(f"camera {name!r} is not known; choose one of {', '.join(names)}")
        camera = mujoco.MjvCamera()
        camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        camera.fixedcamid = names.index(name)
        return camera
