"""A ROS network that only this kernel and its children are in.

Two students on one machine would otherwise drive each other's robot. A domain id of its own separates the
kernel from others on this machine, and a Fast DDS profile keeps it off the network card.
"""

from __future__ import annotations

import fcntl
import os
import random
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from lab.errors import LabError
from ros_runtime.environment import ros_environment

DOMAIN_IDS = range(1, 102)  # higher ones lie in the range of ephemeral ports; 0 is everybody's
LOOPBACK_ONLY = Path(__file__).with_name("loopback_only.xml")


@cache
def join_own_network() -> int:
    """Reserve a domain id until this process ends, put the network's settings into its environment, return the id.

    Raises LabError when every domain is taken.
    """
    domain_id = _reserve_domain()
    os.environ.update(ros_environment(domain_id=domain_id))
    os.environ["FASTRTPS_DEFAULT_PROFILES_FILE"] = str(LOOPBACK_ONLY)
    os.environ.pop("ROS_AUTOMATIC_DISCOVERY_RANGE", None)  # it would override the profile
    return domain_id


def _reserve_domain() -> int:
    """Lock one of the files that stand for domains; the lock lasts as long as the process.

    The grader's arenas lock the same files where they have no network of their own.
    """
    locks = Path(tempfile.gettempdir(), "ros-domain-locks")
    with suppress(FileExistsError):
        locks.mkdir()
        locks.chmod(0o1777)
    for domain_id in random.sample(DOMAIN_IDS, len(DOMAIN_IDS)):
        if _lock(locks / str(domain_id)):
            return domain_id
    raise LabError(f"all {len(DOMAIN_IDS)} ROS domains of this machine are in use: shut down idle kernels")


def _lock(path: Path) -> bool:
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    except FileNotFoundError:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_CREAT, 0o644)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(descriptor)
        return False
    return True
