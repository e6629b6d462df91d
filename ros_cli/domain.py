"""Which ROS domain a command joins."""

from __future__ import annotations

import os

from ros_cli.errors import CommandError
from ros_runtime import notebook_domains
from ros_runtime.ros_domain import require_usable_domain

HELP = """\
Names are full names, such as /robot/odom. In which ROS domain a command looks: in that of the shell,
ROS_DOMAIN_ID, or 0 if it is not set. In the lab, a cell looks in the domain of its own notebook; a terminal
in that of the notebook whose robot or node was started last, unless ROS_DOMAIN_ID is set there."""


def join_domain() -> None:
    """In the lab, put a notebook's domain into the environment of this process, unless one is set there.

    Raises CommandError when what is set there is no domain.
    """
    domain_id = notebook_domains.latest()
    if domain_id is not None:
        os.environ.setdefault("ROS_DOMAIN_ID", str(domain_id))
    try:
        require_usable_domain()
    except ValueError as error:
        raise CommandError(str(error)) from error
