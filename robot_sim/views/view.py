"""Pictures of the robot, drawn off-screen."""

from __future__ import annotations

import copy
from collections.abc import Sequence

import mujoco
import numpy as np

from robot_sim.humanoid import Humanoid
from ros_runtime.workarounds.gl_backend import open_context

DOT_RADIUS, DOT_HEIGHT = 0.07, 0.025  # m


def snapshot(humanoid: Humanoid, width: int = 640, height: int = 480, *, camera: str = "track") -> np.ndarray:
    """Return one RGB picture (height, width, 3), uint8, of the robot where it is.

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
    """A renderer of one robot; `close()` it, because an open OpenGL context outlives its object.

    Args:
        humanoid: the robot to draw.
        width, height: of the pictures, px.
        shadows: draw them; without a graphics card they take most of the time.

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

    def picture(self, camera: str = "track", dots: Sequence[tuple[float, float, str]] = ()) -> np.ndarray:
        """Draw the robot as it is now, RGB (height, width, 3), uint8, through one of the model's cameras.

        `dots` are drawn on the floor: x and y (m), and a colour such as "#0072B2".

        Raises:
            ValueError: the model has no such camera; the message lists its cameras.
        """
        self._gl.make_current()
        mujoco.mjv_updateScene(
            self._model,
            self._data,
            self._option,
            None,
            self._camera(camera),
            mujoco.mjtCatBit.mjCAT_ALL,
            self._scene,
        )
        for x, y, colour in dots:
            self._add_dot(x, y, colour)
        mujoco.mjr_render(self._rectangle, self._scene, self._renderer)
        pixels = np.empty((self._rectangle.height, self._rectangle.width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, self._rectangle, self._renderer)
        return pixels[::-1].copy()  # OpenGL's first row is the lowest

    def close(self) -> None:
        """Free the OpenGL context."""
        self._gl.make_current()
        self._renderer.free()
        self._gl.free()

    def _add_dot(self, x: float, y: float, colour: str) -> None:
        dot = self._scene.geoms[self._scene.ngeom]
        red, green, blue = bytes.fromhex(colour.removeprefix("#"))
        mujoco.mjv_initGeom(
            dot,
            mujoco.mjtGeom.mjGEOM_ELLIPSOID,
            np.array([DOT_RADIUS, DOT_RADIUS, DOT_HEIGHT]),
            np.array([x, y, 0.0]),
            np.eye(3).flatten(),
            np.array([red, green, blue, 255], dtype=np.float32) / 255,
        )
        self._scene.ngeom += 1

    def _camera(self, name: str) -> mujoco.MjvCamera:
        names = [self._model.camera(index).name for index in range(self._model.ncam)]
        if name not in names:
            raise ValueError(f"camera {name!r} is not known; choose one of {', '.join(names)}")
        camera = mujoco.MjvCamera()
        camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        camera.fixedcamid = names.index(name)
        return camera
