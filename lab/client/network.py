"""A ROS domain for this kernel and its child processes alone."""

from __future__ import annotations

import os
from functools import cache

from lab.errors import LabError
from ros_runtime import notebook_domains
from ros_runtime.environment import ros_environment
from ros_runtime.ros_domain import NoDomainLeft, ReservedDomain, loopback_variables


@cache
def join_ros_domain() -> ReservedDomain:
    """Reserve a domain until this process ends and put the network's settings into its environment.

    The terminals of the same lab can join it.

    Raises LabError when every domain is taken.
    """
    try:
        domain = ReservedDomain()
    except NoDomainLeft as error:
        raise LabError(f"{error}: shut down idle kernels") from error
    os.environ.update(ros_environment() | loopback_variables())
    os.environ["ROS_DOMAIN_ID"] = str(domain.domain_id)
    os.environ.pop("ROS_AUTOMATIC_DISCOVERY_RANGE", None)  # it would override the profile
    notebook_domains.announce(domain.domain_id)
    return domain
