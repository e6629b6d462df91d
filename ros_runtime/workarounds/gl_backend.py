"""Open an OpenGL context without a screen, with any backend that this machine has."""

from __future__ import annotations

import importlib
import os
import sys
from typing import Any

BACKENDS = ("egl", "osmesa")  # hardware or Mesa through EGL, else Mesa's off-screen library
HELP = "install libegl1, libgl1-mesa-dri and libopengl0 (EGL) or libosmesa6 (OSMesa)"
_BOUND_TO_A_PLATFORM = ("mujoco.egl", "mujoco.egl.egl_ext", "mujoco.osmesa")


class NoOpenGLError(RuntimeError):
    """This machine has no OpenGL that works without a screen."""


def open_context(width: int, height: int) -> Any:
    """Open an OpenGL context for pictures of up to `width` × `height` px; free it with its `free()`.

    MUJOCO_GL decides when it is set. Otherwise EGL is tried, then OSMesa, and MUJOCO_GL is set to what works.

    Raises:
        NoOpenGLError: none works; the message has the reason for each and what to install.
    """
    asked = os.environ.get("MUJOCO_GL", "").strip().lower()
    reasons = []
    for backend in [asked] if asked else BACKENDS:
        try:
            context = _context_class(backend)(width, height)
        except Exception as error:  # each backend fails in its own way, with any kind of exception
            reasons.append(f"{backend}: {error or type(error).__name__}")
            _forget_pyopengl()
        else:
            os.environ["MUJOCO_GL"] = backend
            return context
    raise NoOpenGLError(f"no OpenGL without a screen ({'; '.join(reasons)}): {HELP}")


def _context_class(backend: str) -> Any:
    if backend not in (*BACKENDS, "glfw"):
        raise ValueError(f"MUJOCO_GL is {backend!r}; expected egl, osmesa or glfw, or unset it")
    return importlib.import_module(f"mujoco.{backend}").GLContext


def _forget_pyopengl() -> None:
    """Drop the modules of a backend that failed: PyOpenGL binds to one platform at its first import."""
    os.environ.pop("PYOPENGL_PLATFORM", None)
    for module in list(sys.modules):
        if module.split(".")[0] == "OpenGL" or module in _BOUND_TO_A_PLATFORM:
            del sys.modules[module]
