"""A limit of time for a build, in processor time: that is the same on a busy machine and on a quiet one."""

from __future__ import annotations

import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NoReturn

GRACE = 5  # s in which the process itself can still say that it took too long


class BuildTooLong(BaseException):
    """A process of the build has used all the processor time it may.

    No Exception: it may come anywhere, also where every Exception of a parser is taken for the file's fault.
    """


@contextmanager
def limit_processor_time(seconds: int | None) -> Iterator[None]:
    """Let neither this process nor any that it starts use more than so many seconds of a processor; None: no limit.

    The limit stays on this process. Raises BuildTooLong where it was reached.
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
        if children.ru_utime + children.ru_stime >= 0.9 * seconds:  # the kernel counts in ticks
            give_up()
        raise
