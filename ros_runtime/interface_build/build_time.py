"""A limit of processor time for a build; unlike a time limit it does not depend on how busy the machine is."""

from __future__ import annotations

import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NoReturn

# A failed build that used this share of the limit counts as too long: the kernel kills a process by its count of clock
# ticks, and the time that it reports afterwards can be shorter.
EXCEEDED_SHARE = 0.5
REPORT_TIME = 5  # s between soft and hard limit, in which the process can still report that it was too long


class BuildTooLong(BaseException):
    """A process of the build has reached its limit of processor time.

    A BaseException, because the interrupted code treats every Exception as a fault of the definition.
    """


@contextmanager
def limit_processor_time(seconds: int | None) -> Iterator[None]:
    """Limit the processor time (s) of this process and of each process that it starts; None: no limit.

    The limit remains after the `with` block.

    Raises:
        BuildTooLong: the limit was reached.
    """
    if seconds is None:
        yield
        return

    def raise_too_long(*_: Any) -> NoReturn:
        raise BuildTooLong(f"building it takes more than {seconds} s")

    signal.signal(signal.SIGXCPU, raise_too_long)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + REPORT_TIME))
    try:
        yield
    except RuntimeError:
        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        if children.ru_utime + children.ru_stime >= EXCEEDED_SHARE * seconds:
            raise_too_long()
        raise
