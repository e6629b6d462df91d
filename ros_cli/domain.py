"""Which ROS domain a command joins."""

from __future__ import annotations

import os

from ros_cli.errors import CommandError
from ros_runtime import notebook_domains
from ros_runtime.ros_domain import require_usable_domain

HELP = """\
Names are full names, such as /robot/odom. A command uses the ROS domain ROS_DOMAIN_ID of the shell, or 0 if it
is not set. In the lab, a cell uses the domain of its own notebook; a terminal uses that of the notebook whose
robot or node was started last, unless ROS_DOMAIN_ID is set there."""


def join_domain() -> None:
    """In the lab, set ROS_DOMAIN_ID of this process to a notebook's domain, unless it is set already.

    Raises CommandError if ROS_DOMAIN_ID is not a usable domain.
    """
    domain_id = notebook_domains.latest()
    if domain_id is not None:
        os.environ.setdefault("ROS_DOMAIN_ID", str(domain_id))
    try:
        require_usable_domain()
    except ValueError as error:
        raise CommandError(str(error)) from error
