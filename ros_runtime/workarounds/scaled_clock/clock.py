"""The writing side of the scaled clock: create the page that an arena's processes share, and set its scale.

    clock = ScaledClock.create(directory / "clock")     # starts at scale 1, real time
    subprocess.Popen(..., env={**env, **clock.environment()})
    ...                                                 # the endpoints are matched
    clock.run_at(5.0)                                   # from now on five times faster in all processes

The processes follow the clock through a preloaded library, built from scaled_clock.c; the first comment there explains
how. The page has the layout of clock_page.h.
"""

from __future__ import annotations

import ctypes
import mmap
import os
import struct
import sys
import time
from pathlib import Path

PAGE_VARIABLE = "SCALED_CLOCK_PAGE"
MAGIC = b"SCALEDCK"
VERSION = 2

_PAGE = struct.Struct("=8sIIqqd")  # magic, version, is set, realtime offset in ns, switch in ns, scale
_IS_SET_OFFSET, _SWITCH_OFFSET = 12, 24

# The switch lies this far in the future, so that no process has read a later time when the switch is published.
_NOTICE_NS = 10_000_000


def preload_variables() -> dict[str, str]:
    """Return the variables of a process whose forks can `follow` a clock; empty if there is no library."""
    library = library_path()
    return {"LD_PRELOAD": str(library)} if library else {}


def follow(path: str | os.PathLike[str]) -> None:
    """Make this process follow the clock at `path`; call it in a single-threaded fork of a process without a clock.

    Raises:
        OSError: the library is not preloaded, or `path` is not a page of this clock.
    """
    try:
        attach = ctypes.CDLL(None).scaled_clock_follow
    except AttributeError:
        raise OSError("the scaled clock's library is not preloaded in this process") from None
    if attach(os.fsencode(path)) != 0:
        raise OSError(f"the clock at {path} cannot be followed")


def library_path() -> Path | None:
    """Return the preloaded library of this environment; None if it could not be built, so that only scale 1 works."""
    path = Path(sys.prefix) / "lib" / "libscaled_clock.so"
    return path if path.exists() else None


class ScaledClock:
    """One arena's clock: equal to the system's clocks until `run_at`.

    Attributes:
        path: of the page that processes read.
        scale: arena seconds per real second, from the switch on.
        switch_ns: the time of the switch to `scale`, on the real CLOCK_MONOTONIC; None before `run_at`.
    """

    def __init__(self, path: Path, page: mmap.mmap, library: Path | None) -> None:
        self.path = path
        self.scale = 1.0
        self.switch_ns: int | None = None
        self._page = page
        self._library = library

    @classmethod
    def create(cls, path: str | os.PathLike[str], *, library: Path | None = None) -> ScaledClock:
        """Create the page file `path`; `library` is the preloaded library, by default `library_path()`.

        Raises:
            FileExistsError: `path` exists.
        """
        offset = time.clock_gettime_ns(time.CLOCK_REALTIME) - time.clock_gettime_ns(time.CLOCK_MONOTONIC)
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o644)
        with os.fdopen(descriptor, "r+b") as file:
            file.write(_PAGE.pack(MAGIC, VERSION, 0, offset, 0, 1.0))
            file.flush()
            page = mmap.mmap(file.fileno(), _PAGE.size)
        return cls(Path(path).resolve(), page, library or library_path())

    def environment(self) -> dict[str, str]:
        """Return the variables that make a process follow this clock; none if the library could not be built."""
        if self._library is None:
            return {}
        return {"LD_PRELOAD": str(self._library), PAGE_VARIABLE: str(self.path)}

    def run_at(self, scale: float) -> None:
        """Switch the clock to `scale` times real time, for all processes at the same instant; it can be called once.

        Returns after the switch, about 10 ms later. Before the switch, sleeping processes wake every 10 ms to read the
        page; after it they sleep without interruption.

        ROS nodes discover each other in real time. Call this only 0.2 s after a client has discovered its server: the
        server may not have discovered the client yet, and at scale 10 its timeout for that is ten times shorter.

        Raises:
            RuntimeError: processes cannot follow, or the clock has been switched already.
        """
        if not 0.01 <= scale <= 100.0:
            raise ValueError(f"a clock cannot run at {scale} times real time; expected 0.01 to 100")
        if scale != 1.0 and self._library is None:
            raise RuntimeError(
                "the library that lets processes follow a scaled clock was not built here; run at scale 1,"
                " or install a C compiler and set up the environment again"
            )
        if self.switch_ns is not None:
            raise RuntimeError(f"this clock stays at scale {self.scale}; create another one")
        self.scale, self.switch_ns = scale, self._publish(scale)
        while real_monotonic_ns() < self.switch_ns:
            time.sleep(0.001)

    def _publish(self, scale: float) -> int:
        """Publish a switch in the near future; return its time, in ns of the real CLOCK_MONOTONIC."""
        while True:
            switch = real_monotonic_ns() + _NOTICE_NS
            struct.pack_into("=qd", self._page, _SWITCH_OFFSET, switch, scale)
            # If this is too late, the clock would jump in processes that have read a time after the switch: try again.
            if real_monotonic_ns() < switch - _NOTICE_NS // 2:
                struct.pack_into("=I", self._page, _IS_SET_OFFSET, 1)
                return switch


def real_monotonic_ns() -> int:
    """Return the real CLOCK_MONOTONIC, in ns, also in a process that itself follows a scaled clock."""
    read = getattr(ctypes.CDLL(None), "scaled_clock_real_monotonic_ns", None)
    if read is None:
        return time.monotonic_ns()
    read.restype = ctypes.c_int64
    return read()
