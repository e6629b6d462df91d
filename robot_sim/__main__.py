"""`python -m robot_sim`: the robot node alone."""

from __future__ import annotations

import sys

from robot_sim.ros.serve import parse_options, serve_robot
from ros_runtime.ros_domain import require_usable_domain


def main() -> None:
    """Run the robot until SIGINT or SIGTERM."""
    options = parse_options()
    try:
        require_usable_domain()
    except ValueError as error:
        sys.exit(f"course sim: {error}")
    serve_robot(options)


if __name__ == "__main__":
    main()
