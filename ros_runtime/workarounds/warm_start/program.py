"""Turns this process into a Python program, as if it had been started by `python FILE ARGUMENTS`."""

from __future__ import annotations

import atexit
import builtins
import ctypes
import gc
import os
import signal
import sys
import threading
from collections.abc import Mapping, Sequence
from types import ModuleType


def run_program(arguments: Sequence[str], environment: Mapping[str, str], folder: str) -> int:
    """Run `arguments[0]` in `folder` as the main program; return the exit status, unless it calls sys.exit.

    The interpreter itself handles tracebacks, SystemExit and Ctrl-C, as for any program.
    """
    os.environ.clear()
    os.environ.update(environment)
    os.environ["PWD"] = folder  # a shell sets it, too
    os.chdir(folder)
    if os.environ.get("PYTHONFAULTHANDLER"):
        import faulthandler  # a new interpreter imports it only with this variable

        faulthandler.enable()
    path = os.path.abspath(arguments[0])
    sys.argv = list(arguments)
    sys.orig_argv = [sys.executable, *arguments]
    sys.path[0] = os.path.dirname(path)
    sys.path_importer_cache.clear()  # its folder listings are from outside the sandbox
    _draw_new_seeds()
    sys.modules["__main__"] = _empty_main()
    gc.enable()
    if _run_as_main(path) == 0:
        return 0
    if getattr(sys, "last_type", None) is KeyboardInterrupt:
        _end_as_interrupted()
    return 1


def _run_as_main(path: str) -> int:
    """Run the file in __main__; its traceback, if any, begins there. Does not return from a SystemExit."""
    libc = ctypes.CDLL(None)
    libc.fopen.restype = ctypes.c_void_p
    file = libc.fopen(os.fsencode(path), b"rb")
    if not file:
        print(
            f"{sys.executable}: can't open file {path!r}: [Errno 2] No such file or directory",
            file=sys.stderr,
        )
        sys.exit(2)
    run = ctypes.pythonapi.PyRun_SimpleFileExFlags
    run.argtypes = (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_void_p)
    return run(file, os.fsencode(path), 1, None)


def _empty_main() -> ModuleType:
    module = ModuleType("__main__")
    module.__dict__.update(__builtins__=builtins, __annotations__={})
    return module


def _draw_new_seeds() -> None:
    """Reseed NumPy's global generator, which would be the same in every fork; Python's `random` reseeds itself."""
    for finder in sys.meta_path:
        hidden = getattr(finder, "_hidden", {})
        if random := hidden.get("numpy.random"):
            random.seed()


def _end_as_interrupted() -> None:
    """Exit by SIGINT, so that the parent gets the same status as from any program that Ctrl-C ends."""
    threading._shutdown()  # type: ignore[attr-defined]
    atexit._run_exitfuncs()
    sys.stdout.flush()
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    os.kill(os.getpid(), signal.SIGINT)
