"""Reserve a ROS domain, and keep its nodes on the loopback interface.

Otherwise the nodes of two students on one machine would move each other's robot, and so would those of two arenas.
"""

from __future__ import annotations

import fcntl
import os
import random
import tempfile
from contextlib import suppress
from pathlib import Path

# The ports of other domains lie in Linux's range of ephemeral ports. Domain 0 is the default of ROS, so others use it.
DOMAIN_IDS = (*range(1, 102), *range(215, 233))
LAST_DOMAIN_ID = 232  # the highest one for which DDS has ports
LOOPBACK_ONLY = Path(__file__).with_name("loopback_only.xml")


class NoDomainLeft(Exception):
    """Every ROS domain that is safe to use is taken by another process on this machine."""


def require_usable_domain() -> None:
    """Require that ROS_DOMAIN_ID, if it is set, names a domain that DDS has ports for.

    Raises:
        ValueError: DDS has no ports for the domain; the message says what to do.
    """
    given = os.environ.get("ROS_DOMAIN_ID", "")
    if given and not (given.isascii() and given.isdigit() and int(given) <= LAST_DOMAIN_ID):
        raise ValueError(
            f"ROS_DOMAIN_ID is {given[:40]!r}, expected a number from 0 to {LAST_DOMAIN_ID}.\n"
            "Next: type `unset ROS_DOMAIN_ID`, or set it to another number."
        )


class ReservedDomain:
    """A ROS domain that this process reserves until it releases the domain or ends. All users share the locks.

    Attributes:
        domain_id: one of `DOMAIN_IDS`.

    Raises:
        NoDomainLeft: all are taken.
    """

    def __init__(self) -> None:
        locks = _locks()
        with suppress(FileExistsError):
            locks.mkdir()
            locks.chmod(0o1777)
        for domain_id in random.sample(DOMAIN_IDS, len(DOMAIN_IDS)):
            if (descriptor := _lock(locks / str(domain_id))) is not None:
                self.domain_id, self._descriptor = domain_id, descriptor
                return
        raise NoDomainLeft(f"all {len(DOMAIN_IDS)} ROS domains are in use on this machine")

    def release(self) -> None:
        """Release the domain for other processes."""
        os.close(self._descriptor)

    def __enter__(self) -> int:
        return self.domain_id

    def __exit__(self, *_: object) -> None:
        self.release()


def is_reserved(domain_id: int) -> bool:
    """Return whether some process has reserved a domain."""
    path = _locks() / str(domain_id)
    if not path.exists():
        return False
    if (descriptor := _lock(path)) is None:
        return True
    os.close(descriptor)
    return False


def loopback_variables() -> dict[str, str]:
    """Return the variables that keep nodes on 127.0.0.1 and let them find each other on a busy machine."""
    return {"FASTRTPS_DEFAULT_PROFILES_FILE": str(LOOPBACK_ONLY)}


def _locks() -> Path:
    return Path(tempfile.gettempdir(), "ros-domain-locks")


def _lock(path: Path) -> int | None:
    """Return a descriptor that locks a file; None if another process, of any user, has locked it."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    except FileNotFoundError:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_CREAT, 0o644)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(descriptor)
        return None
    return descriptor
