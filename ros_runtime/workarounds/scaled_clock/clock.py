"""The writing side of the scaled clock: create the page that an arena's processes share, and set its pace.

    clock = ScaledClock.create(directory / "clock")     # starts at the pace of real time
    subprocess.Popen(..., env={**env, **clock.environment()})
    ...                                                 # the endpoints are matched
    clock.run_at(5.0)                                   # from here on five times faster, for all at once

The processes follow it through the preloaded library built from scaled_clock.c, whose head says how. The
layout of the page is that of clock_page.h.
"""

from __future__ import annotations

import ctypes
import mmap
import os
import struct
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

PAGE_VARIABLE = "SCALED_CLOCK_PAGE"
MAGIC = b"SCALEDCK"
VERSION = 1
MAX_SEGMENTS = 16

# magic, version, segment count, is final, reserved, realtime offset in ns
_HEADER = struct.Struct("=8sIIIIq")
_COUNT_OFFSET, _FINAL_OFFSET = 12, 16
_SEGMENT = struct.Struct("=qqd")  # real start in ns, scaled start in ns, scale
_SIZE = _HEADER.size + MAX_SEGMENTS * _SEGMENT.size

# A new pace starts this far in the future: nobody may have read a time beyond it when it is published.
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
    """Return the preloaded library of this environment; None if it could not be built, so all runs at scale 1."""
    path = Path(sys.prefix) / "lib" / "libscaled_clock.so"
    return path if path.exists() else None


class Segment(NamedTuple):
    """From `real_start_ns` of CLOCK_MONOTONIC on, the clock runs at `scale` arena seconds per real second."""

    real_start_ns: int
    scaled_start_ns: int
    scale: float


class ScaledClock:
    """One arena's clock. `create` makes it, `open` joins it from another process; either may write it."""

    def __init__(self, path: Path, page: mmap.mmap, library: Path | None) -> None:
        self.path = path
        self._page = page
        self._library = library

    @classmethod
    def create(cls, path: str | os.PathLike[str], *, library: Path | None = None) -> ScaledClock:
        """Create the page file `path`: scale 1, equal to the system's clocks until `run_at`.

        `library` is the preloaded library, by default `library_path()`.

        Raises:
            FileExistsError: `path` exists.
        """
        now = real_monotonic_ns()
        offset = time.clock_gettime_ns(time.CLOCK_REALTIME) - time.clock_gettime_ns(time.CLOCK_MONOTONIC)
        header = _HEADER.pack(MAGIC, VERSION, 1, 0, 0, offset)
        content = (header + _SEGMENT.pack(now, now, 1.0)).ljust(_SIZE, b"\0")
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o644)
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        return cls.open(path, library=library)

    @classmethod
    def open(cls, path: str | os.PathLike[str], *, library: Path | None = None) -> ScaledClock:
        """Open the clock at `path`; without write permission it can only be read.

        Raises:
            OSError: there is none.
            ValueError: it is not a page of this version.
        """
        path = Path(path).resolve()
        writable = os.access(path, os.W_OK)
        with open(path, "r+b" if writable else "rb") as file:
            size = os.fstat(file.fileno()).st_size
            if size < _SIZE:
                raise ValueError(f"{path} has {size} bytes; a clock page has {_SIZE}. Is it another file?")
            access = mmap.ACCESS_WRITE if writable else mmap.ACCESS_READ
            page = mmap.mmap(file.fileno(), _SIZE, access=access)
        magic, version, *_ = _HEADER.unpack_from(page)
        if (magic, version) != (MAGIC, VERSION):
            raise ValueError(
                f"{path} starts with {magic!r}, version {version}; expected {MAGIC!r}, version {VERSION}."
                " Was it made by another release of this package?"
            )
        return cls(path, page, library or library_path())

    def environment(self, base: Mapping[str, str] | None = None) -> dict[str, str]:
        """Return the variables that make a process follow this clock; libraries that `base` preloads stay preloaded.

        They are empty if the preloaded library could not be built.
        """
        if self._library is None:
            return {}
        already = (base or {}).get("LD_PRELOAD", "")
        return {"LD_PRELOAD": f"{self._library} {already}".rstrip(), PAGE_VARIABLE: str(self.path)}

    def run_at(self, scale: float, *, final: bool = True) -> None:
        """Let the clock run `scale` times as fast as real time, for all processes from the same instant on.

        Returns when that instant has come, about 10 ms later. `final` promises that the pace stays: processes then
        sleep without interruption, instead of waking every 10 ms to read the page.

        ROS nodes discover each other in real time. Speed up only 0.2 s after a client has found its server: the server
        may not have discovered the client yet, and at scale 10 its timeout for that is ten times shorter.

        Raises:
            RuntimeError: processes cannot follow, the clock is final, or it was changed 15 times.
        """
        if not 0.01 <= scale <= 100.0:
            raise ValueError(f"a clock cannot run {scale} times as fast as the wall; expected 0.01 to 100")
        if scale != 1.0 and self._library is None:
            raise RuntimeError(
                "the library that lets processes follow a scaled clock was not built here; run at scale 1,"
                " or install a C compiler and set up the environment again"
            )
        if self.is_final:
            raise RuntimeError(f"this clock was promised to stay at scale {self.scale}; create another one")
        count = self._count()
        if count == MAX_SEGMENTS:
            raise RuntimeError(f"this clock has changed its pace {count - 1} times and has no room for more")
        start = self._append(count, scale)
        if final:
            struct.pack_into("=I", self._page, _FINAL_OFFSET, 1)
        while real_monotonic_ns() < start:
            time.sleep(0.001)

    def _append(self, count: int, scale: float) -> int:
        """Publish a segment that starts soon; return its real start in ns."""
        while True:
            start = real_monotonic_ns() + _NOTICE_NS
            where = _HEADER.size + count * _SEGMENT.size
            _SEGMENT.pack_into(self._page, where, start, self.scaled_ns(start), scale)
            # Publishing late would let the clock jump for those who have read beyond the start; so try again.
            if real_monotonic_ns() < start - _NOTICE_NS // 2:
                struct.pack_into("=I", self._page, _COUNT_OFFSET, count + 1)
                return start

    @property
    def scale(self) -> float:
        """Arena seconds per real second, from the newest change on."""
        return self.segments()[-1].scale

    @property
    def is_final(self) -> bool:
        """Whether the pace was promised to stay."""
        return bool(struct.unpack_from("=I", self._page, _FINAL_OFFSET)[0])

    def segments(self) -> list[Segment]:
        """Return the clock's paces so far, oldest first; the newest may begin a few ms from now."""
        count = self._count()
        return [
            Segment(*_SEGMENT.unpack_from(self._page, _HEADER.size + i * _SEGMENT.size)) for i in range(count)
        ]

    def scaled_ns(self, real_ns: int) -> int:
        """Return the arena's CLOCK_MONOTONIC, in ns, at an instant of the real one."""
        segments = self.segments()
        segment = next((each for each in reversed(segments) if each.real_start_ns <= real_ns), segments[0])
        return segment.scaled_start_ns + int((real_ns - segment.real_start_ns) * segment.scale)

    def now(self) -> float:
        """Return the arena's CLOCK_MONOTONIC, in s: what `time.monotonic()` gives a process that follows it."""
        return self.scaled_ns(real_monotonic_ns()) * 1e-9

    def _count(self) -> int:
        return struct.unpack_from("=I", self._page, _COUNT_OFFSET)[0]


def real_monotonic_ns() -> int:
    """Return the real CLOCK_MONOTONIC, in ns, also in a process that itself follows a scaled clock."""
    read = getattr(ctypes.CDLL(None), "scaled_clock_real_monotonic_ns", None)
    if read is None:
        return time.monotonic_ns()
    read.restype = ctypes.c_int64
    return read()
