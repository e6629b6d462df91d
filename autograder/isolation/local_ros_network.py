"""A corner of the host's own network for one arena, where it cannot have a network of its own."""

from __future__ import annotations

import fcntl
import os
import random
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from autograder.isolation.bubblewrap import SandboxError

# The ports of other domains lie in the range from which Linux takes ephemeral ports; 0 is what people use.
_DOMAINS = [*range(1, 102), *range(215, 233)]
_PROFILE = """<?xml version="1.0" encoding="UTF-8"?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <transport_descriptors>
    <transport_descriptor>
      <transport_id>loopback</transport_id>
      <type>UDPv4</type>
      <interfaceWhiteList><address>127.0.0.1</address></interfaceWhiteList>
    </transport_descriptor>
  </transport_descriptors>
  <participant profile_name="loopback_only" is_default_profile="true">
    <rtps>
      <userTransports><transport_id>loopback</transport_id></userTransports>
      <useBuiltinTransports>false</useBuiltinTransports>
    </rtps>
  </participant>
</profiles>
"""


class NoDomainLeftError(SandboxError):
    """Every ROS domain id that is safe to use is taken by another arena on this machine."""


@contextmanager
def reserve_domain(folder: Path) -> Iterator[dict[str, str]]:
    """Reserve a ROS domain id; yields the environment that keeps nodes to it and to 127.0.0.1.

    The transport's profile is written to `folder`. Raises :class:`NoDomainLeftError`.
    """
    profile = folder / "loopback_only.xml"
    profile.write_text(_PROFILE)
    for domain in random.sample(_DOMAINS, len(_DOMAINS)):
        if (lock := _lock(domain)) is not None:
            try:
                yield {"ROS_DOMAIN_ID": str(domain), "FASTRTPS_DEFAULT_PROFILES_FILE": str(profile)}
            finally:
                os.close(lock)
            return
    raise NoDomainLeftError(
        f"all {len(_DOMAINS)} ROS domain ids are in use by arenas on this machine: run fewer at once"
    )


def _lock(domain: int) -> int | None:
    """Return a descriptor that locks a domain, or None when another process, of any user, has locked it."""
    locks = Path(tempfile.gettempdir(), "ros-domain-locks")
    with suppress(FileExistsError):
        locks.mkdir()
        locks.chmod(0o1777)
    path = locks / str(domain)
    try:
        fd = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    except FileNotFoundError:
        fd = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_CREAT, 0o644)
    try:
        fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(fd)
        return None
    return fd
