"""A time limit for a build, in processor time, which is the same on a busy machine and on a quiet one."""

from __future__ import annotations

import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NoReturn

ENOUGH = (
    0.5  # share of the limit: the kernel kills by counted ticks but reports measured time, which can be less
)
GRACE = 5  # s between soft and hard limit, in which the process can still report the timeout


class BuildTooLong(BaseException):
    """A process of the build has reached its limit of processor time.

    A BaseException, because code that it interrupts takes every Exception for a fault of the file.
    """


@contextmanager
def limit_processor_time(seconds: int | None) -> Iterator[None]:
    """Limit the processor time (s) of this process and of each that it starts; None: no limit.

    The limit stays on this process.

    Raises:
        BuildTooLong: the limit was reached.
    """
    if seconds is None:
        yield
        return

    def give_up(*_: Any) -> NoReturn:
        raise BuildTooLong(f"building it takes more than {seconds} s")

    signal.signal(signal.SIGXCPU, give_up)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + GRACE))
    try:
        yield
    except RuntimeError:
        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        if children.ru_utime + children.ru_stime >= ENOUGH * seconds:
            give_up()
        raise
