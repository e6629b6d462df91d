"""Workers of a Dask cluster. `distributed` is imported only here, and only for `course grade --dask`."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from autograder.classroom.batch.worker_pool import Workers
from autograder.isolation.availability import Isolation, available_isolation
from ros_runtime.course_error import CommandFailed

MAX_UNFINISHED_JOBS = 1000  # jobs submitted ahead, so that an adaptive cluster sees the demand and grows
_CONNECT_TIMEOUT = 30.0  # s, to connect to the scheduler and for the first worker to join


@dataclass(frozen=True)
class Cluster:
    """The workers that may grade, their isolation and number, and a sentence on each worker that is left out."""

    workers: Workers
    isolation: Isolation
    size: int
    left_out: tuple[str, ...]


@contextmanager
def dask_cluster(address: str) -> Iterator[Cluster]:
    """Connect to a scheduler and query each worker's isolation.

    If only some workers are isolated, only those grade. Each job checks its worker again, because workers may join
    later.

    Raises:
        CourseError: `distributed` is not installed, no scheduler responds, or the cluster has no usable worker.
    """
    try:
        from distributed import Client
    except ImportError as error:
        install = f"{sys.executable} -m uv pip install --python {sys.executable} -c requirements.lock dask distributed"
        raise CommandFailed(f"--dask needs the package distributed: {install}") from error
    try:
        client = Client(address, timeout=_CONNECT_TIMEOUT, set_as_default=False)
    except (OSError, ValueError) as error:
        raise CommandFailed(
            f"no Dask scheduler responds at {address} ({error}); start one with: dask scheduler"
        ) from error
    with client:
        try:
            client.wait_for_workers(1, timeout=_CONNECT_TIMEOUT)
        except (TimeoutError, asyncio.TimeoutError) as error:  # two classes before Python 3.11
            raise CommandFailed(
                f"the scheduler at {address} has no worker; start one in a clone: .venv/bin/dask worker {address}"
            ) from error
        try:
            found: dict[str, Isolation] = client.run(available_isolation)
        except Exception as error:  # Dask decides which exception a worker without this toolkit raises
            raise CommandFailed(
                f"a worker cannot run this toolkit ({type(error).__name__}: {error}); start every worker with the "
                ".venv/bin/dask of a clone at the same commit"
            ) from error
        yield _cluster(client, found)


def _cluster(client: object, found: dict[str, Isolation]) -> Cluster:
    isolated = [worker for worker, isolation in found.items() if isolation.trusted]
    chosen = isolated or list(found)
    left_out = tuple(
        f"the worker {worker} has no isolation and gets no jobs: {found[worker].reason}"
        for worker in found
        if worker not in chosen
    )
    only = {"workers": chosen} if left_out else {}
    workers = Workers(lambda: client.get_executor(pure=False, **only), MAX_UNFINISHED_JOBS)  # type: ignore[attr-defined]
    return Cluster(workers, found[chosen[0]], len(chosen), left_out)
