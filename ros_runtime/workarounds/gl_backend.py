"""Open an OpenGL context without a screen, with any backend that this machine has."""

from __future__ import annotations

import importlib
import os
import sys
from typing import Any

VARIABLE = "MUJOCO_GL"
BACKENDS = ("egl", "osmesa")  # hardware or Mesa through EGL, else Mesa's off-screen library
_DISABLED = ("disable", "disabled", "off", "false", "0")  # values of MUJOCO_GL that switch OpenGL off
HELP = "install libegl1, libgl1-mesa-dri and libopengl0 (EGL) or libosmesa6 (OSMesa)"
_PLATFORM_MODULES = ("mujoco.egl", "mujoco.egl.egl_ext", "mujoco.osmesa")


def _take_from_environment() -> str:
    """Remove MUJOCO_GL from the environment, unless it switches OpenGL off; return its value.

    Otherwise `import mujoco` fails if the variable names a backend that is unknown or not installed.
    """
    backend = os.environ.get(VARIABLE, "").strip().lower()
    if backend not in _DISABLED:
        os.environ.pop(VARIABLE, None)
    return backend


_initial_backend = _take_from_environment()


class NoOpenGLError(RuntimeError):
    """This machine has no OpenGL that works without a screen."""


def open_context(width: int, height: int) -> Any:
    """Open an OpenGL context for pictures of up to `width` × `height` px; free it with its `free()`.

    MUJOCO_GL=egl or osmesa selects the backend. With any other value, such as one that needs a screen, EGL and then
    OSMesa are tried, and MUJOCO_GL is set to the one that works.

    Raises:
        NoOpenGLError: no backend works; the message has the reason for each and what to install.
    """
    wanted = _take_from_environment() or _initial_backend
    reasons = []
    for backend in [wanted] if wanted in BACKENDS else BACKENDS:
        try:
            context = importlib.import_module(f"mujoco.{backend}").GLContext(width, height)
        except Exception as error:  # each backend fails in its own way, with any kind of exception
            reasons.append(f"{backend}: {error or type(error).__name__}")
            _forget_pyopengl()
        else:
            os.environ[VARIABLE] = backend
            return context
    raise NoOpenGLError(f"no OpenGL without a screen ({'; '.join(reasons)}): {HELP}")


def _forget_pyopengl() -> None:
    """Remove the modules of a failed backend from `sys.modules`: PyOpenGL chooses its platform at the first import."""
    os.environ.pop("PYOPENGL_PLATFORM", None)
    for module in list(sys.modules):
        if module.split(".")[0] == "OpenGL" or module in _PLATFORM_MODULES:
            del sys.modules[module]
