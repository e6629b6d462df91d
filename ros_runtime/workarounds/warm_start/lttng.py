"""Support for forks with LTTng, which ROS's tracepoints load: its threads must be restarted in the child.

After two forks in a row only the last process calls `after_in_child`; the intermediate one just waits.
"""

from __future__ import annotations

import ctypes
import os
from contextlib import suppress

_PREFIXES = ("ust_", "lttng_ust_")  # of the functions, before and since LTTng 2.13


class ForkGuard:
    """Makes the calls of liblttng-ust-fork around a fork; does nothing if LTTng is not loaded."""

    def __init__(self) -> None:
        self._signals = ctypes.create_string_buffer(128)  # a sigset_t
        self._library = _loaded_library()
        self._prefix = next((p for p in _PREFIXES if hasattr(self._library, p + "before_fork")), "")

    def before(self) -> None:
        """Call it before the fork."""
        self._call("before_fork")

    def after_in_parent(self) -> None:
        """Call it after the fork in the parent."""
        self._call("after_fork_parent")

    def after_in_child(self) -> None:
        """Call it in the child that becomes a program; it starts LTTng's threads."""
        self._call("after_fork_child")

    def _call(self, function: str) -> None:
        if self._prefix:
            getattr(self._library, self._prefix + function)(self._signals)


def _loaded_library() -> ctypes.CDLL | None:
    with open("/proc/self/maps") as maps:
        paths = {line.split()[-1] for line in maps if "/liblttng-ust" in line}
    for path in sorted(paths):
        name = os.path.basename(path)
        if name.startswith(("liblttng-ust.", "liblttng-ust-")) and "tracepoint" not in name:
            with suppress(OSError):
                return ctypes.CDLL(path, mode=os.RTLD_NOLOAD | os.RTLD_NOW)
    return None
